"""In a Debian system that has only what apt needs (debootstrap, variant minbase), without a compiler, the package
`vitrel` was installed, the sweep of `params/demo.toml` run, and its page written:

{steps}

At most {LIMIT} s are allowed. The load of the machine before was {load:.1f}, with {processors} processors. Then a state
was prepared in Python with `python3-vitrel`, `vitrel bench` ran `vitrel-bench`, and the client of
`tests/clients/find_package` was built with `libvitrel-dev` and ran. The dynamic linker takes the build for x86-64-v3
where the processor has AVX2, and the other one under the mask of an old processor. Nothing stays when the packages are
removed. Sizes of the packages:

{sizes}
"""

import os
import pathlib
import shutil
import subprocess

from validation.bare_system import bare_system, inside, install, require_root, timed
from validation.common import OLD_PROCESSOR, ROOT, expect, expect_chart, table

TITLE = "The packages in a bare Debian"
INPUTS = ["CMakeLists.txt", "cmake", "scripts/release", "pyproject.toml"]
PACKAGES = ROOT / "build/packages"
LIMIT = 120  # seconds from `apt install` to the page
SUITE = "bookworm"

STATE = """
import vitrel
state = vitrel.prepare(aspect_ratio=2, particles=100, packing_fraction=0.6, seed=1, quiet=True)
assert len(state) == 100
assert abs(state.packing_fraction - 0.6) < 1e-9
print(vitrel.version)
"""


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
    expect_chart(root / "root/demo/report.html")
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
    require_root()
    subprocess.run([ROOT / "scripts/release", "--try"], check=True)
    return check(PACKAGES)


def check(packages):
    """The section of the page for packages in this folder."""
    with bare_system(SUITE) as root:
        for package in packages.glob("*.deb"):
            shutil.copy(package, root / "root")
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
    rows = [(step, f"{seconds:.1f}") for step, seconds in (*steps.items(), ("together", total))]
    return {"steps": table(["step", "s"], rows), "load": load, "processors": os.cpu_count(),
            "sizes": table(["package", "MB"], sizes)}
