"""The packages in a bare Debian: from `apt install` to the picture of the demo, Python, and a client of the libraries.

Needs root, but no mount and no process outlives a command: every command for the new system has namespaces of its own.
"""

import contextlib
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

from validation.common import OLD_PROCESSOR, ROOT, expect, output_of, table

TITLE = "The packages in a bare Debian"
PACKAGES = ROOT / "build/packages"
LIMIT = 120  # seconds from `apt install` to the page
SUITE = "bookworm"
APART = ["unshare", "--mount", "--pid", "--fork", "--kill-child", "--mount-proc"]

STATE = """
import vitrel
state = vitrel.prepare(aspect_ratio=2, particles=100, packing_fraction=0.6, seed=1, quiet=True)
assert len(state) == 100
assert abs(state.packing_fraction - 0.6) < 1e-9
print(vitrel.version)
"""


def lines_of(command):
    return output_of(command).splitlines()


def archives():
    """What this machine has for archives of Debian, as lines of sources.list by release."""
    form = "$(RELEASE) deb $(REPO_URI) $(RELEASE) $(COMPONENT)"
    found = lines_of(["apt-get", "indextargets", "Created-By: Packages", "Origin: Debian", "--format", form])
    return dict(line.split(maxsplit=1) for line in found)


def install_bare_system(root):
    """A Debian without anything more than apt needs, with the archives of this machine and how apt gets there."""
    sources = archives()
    expect(SUITE in sources, f"apt has no archive of {SUITE}; run apt-get update")
    mirror = sources[SUITE].split()[1]
    output_of([*APART, "debootstrap", "--variant=minbase", SUITE, root, mirror])
    (root / "etc/apt/sources.list").write_text("\n".join(sources.values()) + "\n", encoding="utf-8")
    settings = [line for line in lines_of(["apt-config", "dump"]) if line.startswith("Acquire::")]
    (root / "etc/apt/apt.conf.d/99host").write_text("\n".join(settings) + "\n", encoding="utf-8")
    shutil.copy("/etc/resolv.conf", root / "etc/resolv.conf")


@contextlib.contextmanager
def bare_system():
    """The folder of such a system, which is removed in the end, also when the validation is stopped."""
    def stop(number, _):
        raise SystemExit(128 + number)

    before = signal.signal(signal.SIGTERM, stop)
    folder = pathlib.Path(tempfile.mkdtemp(prefix="vitrel-packages-"))
    try:
        root = folder / "root"
        install_bare_system(root)
        yield root
    finally:
        subprocess.run(["rm", "-rf", "--one-file-system", folder], check=True)
        signal.signal(signal.SIGTERM, before)


def inside(root, command, **variables):
    """The standard output of a shell command in the system."""
    environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LC_ALL": "C.UTF-8",
                   "DEBIAN_FRONTEND": "noninteractive", **variables}
    return output_of([*APART, f"--root={root}", "--wd=/root", "sh", "-euc", command], env=environment,
                     stdin=subprocess.DEVNULL)


def install(root, *names):
    """Packages of the release that are in /root, and others of the distribution."""
    inside(root, f"apt-get install -qq --no-install-recommends -o Dpkg::Use-Pty=0 {' '.join(names)}")


def timed(work, *arguments):
    start = time.monotonic()
    work(*arguments)
    return time.monotonic() - start


def library(root, file, name, **variables):
    """The library of this name that the dynamic linker chooses for a program or a module."""
    found = inside(root, f"/lib64/ld-linux-x86-64.so.2 --list {file}", **variables).splitlines()
    return next(line.split("=>")[1].split()[0] for line in found if name in line)


def picture(root):
    """From a bare system to the page of the demo: seconds of the steps."""
    expect(inside(root, "command -v cc c++ gcc g++ || true") == "", "the bare system has a compiler")
    examples = "/usr/share/doc/vitrel/examples"
    steps = {"`apt install ./vitrel_*.deb`": timed(install, root, "./vitrel_*.deb"),
             "`vitrel sweep demo.toml -o demo -j 2`":
                 timed(inside, root, f"vitrel sweep {examples}/demo.toml -o demo -j 2"),
             "`vitrel report demo`": timed(inside, root, "vitrel report demo")}
    page = (root / "root/demo/report.html").read_text(encoding="utf-8")
    expect("<svg" in page or "<canvas" in page or "uPlot" in page, "the page has no chart")
    return steps


def check_processors(root):
    """Old processors get the first build, newer ones the second."""
    newer = "avx2" in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
    module = "/usr/lib/python3/dist-packages/vitrel/_vitrel.*.so"
    for file, name in (("/usr/bin/vitrel", "libvitrel_program"), (module, "libvitrel_python")):
        chosen = library(root, file, name)
        expect(("x86-64-v3" in chosen) == newer, f"the dynamic linker takes {chosen}")
        chosen = library(root, file, name, **OLD_PROCESSOR)
        expect("x86-64-v3" not in chosen, f"an old processor gets {chosen}")


def check_removal(root):
    """Nothing of the packages stays when they are removed."""
    inside(root, "apt-get purge -qq vitrel vitrel-bench libvitrel-dev python3-vitrel")
    left = inside(root, "find /usr /etc -name '*vitrel*'").split()
    expect(not left, f"left behind: {', '.join(left)}")


def measure(_):
    expect(os.geteuid() == 0, "needs root, to install packages in a system of their own")
    subprocess.run([ROOT / "scripts/release", "--try"], check=True)
    return check(PACKAGES)


def check(packages):
    """The section of the page for packages in this folder."""
    with bare_system() as root:
        for package in packages.glob("*.deb"):
            shutil.copy(package, root / "root")
        inside(root, "apt-get update -qq")
        load = os.getloadavg()[0]
        steps = picture(root)
        total = sum(steps.values())
        version = inside(root, "vitrel version").strip()

        install(root, "./python3-vitrel_*.deb", "./vitrel-bench_*.deb")
        expect(inside(root, f"python3 -c '{STATE}'").strip() == version, "the Python package has another version")
        expect(inside(root, "vitrel bench version").strip() == version, "vitrel-bench has another version")
        check_processors(root)

        install(root, "./libvitrel-dev_*.deb", "g++", "cmake", "make")
        shutil.copytree(ROOT / "tests/clients/find_package", root / "root/client")
        inside(root, "cmake -S client -B build -DCMAKE_BUILD_TYPE=Release && cmake --build build && build/client")
        check_removal(root)
    expect(total <= LIMIT, f"{total:.0f} s from apt install to the page, more than {LIMIT} s")
    sizes = [(f"`{file.name}`", f"{file.stat().st_size / 1e6:.2f}") for file in sorted(packages.glob("*.deb"))]
    return f"""In a Debian system that has only what apt needs (debootstrap, variant minbase), without a compiler, the package
`vitrel` was installed, the sweep of `params/demo.toml` run, and its page written:

{table(["step", "s"], [*((step, f"{seconds:.1f}") for step, seconds in steps.items()), ("together", f"{total:.1f}")])}

At most {LIMIT} s are allowed. The load of the machine before was {load:.1f}, with {os.cpu_count()} processors. Then a state was prepared in
Python with `python3-vitrel`, `vitrel bench` ran `vitrel-bench`, and the client of `tests/clients/find_package` was built
with `libvitrel-dev` and ran. The dynamic linker takes the build for x86-64-v3 where the processor has AVX2, and the other
one under the mask of an old processor. Nothing stays when the packages are removed. Sizes of the packages:

{table(["package", "MB"], sizes)}"""
