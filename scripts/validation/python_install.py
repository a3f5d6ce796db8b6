"""In a Debian 13 system that has only what apt needs, without a package index, the packages of
`scripts/install_dependencies build python wheel` were installed in {dependencies:.0f} s, and vitrel in {seconds:.0f} s
by

    pip install --no-build-isolation .

into a virtual environment with the system's packages (load before: {load:.1f}, {processors} processors). In Python, a
state was prepared, and a run and a sweep of two densities were made, with the program that pip had installed, although
its folder was not in the path. A source distribution, which has no git, was installed in the same way: it has the same
files, says the same commit, and computes the same numbers. In `site-packages` there is nothing but the package `vitrel`
and its metadata; the program and its texts are where the environment has such files. Program and module have no
instructions of newer processors and name no folder of libraries. Nothing stays when the package is removed.

{table}
"""

import json
import os
import re
import shlex

from validation.bare_system import bare_system, inside, require_root, timed
from validation.common import ROOT, expect, output_of, table

TITLE = "Installation with pip"
INPUTS = ["CMakeLists.txt", "cmake", "python", "pyproject.toml", "scripts/install_dependencies"]
SUITE = "trixie"
PIP = "pip install --quiet --no-build-isolation"

# One state, one run, one sweep; the program is found although its folder is not in the path.
WORK = """
import importlib.metadata, json, sys, vitrel
state = vitrel.prepare(aspect_ratio=2, particles=100, packing_fraction=0.6, seed=1, quiet=True)
run = vitrel.run(state, duration=2, equilibration=1, output=sys.argv[1] + ".h5", quiet=True)
sweep = vitrel.sweep(output=sys.argv[1], grid={"system.packing_fraction": [0.3, 0.4]}, particles=50, aspect_ratio=2,
                     duration=5, equilibration=1, prepare__quality_sweeps=0, quiet=True)
table = sweep.results["runs"]
print(json.dumps({"version": vitrel.version, "commit": vitrel.commit,
                  "distribution": importlib.metadata.version("vitrel"), "msd": run.msd.value.tolist(),
                  "sweep": table["packing_fraction"].value.round(6).tolist(),
                  "pressures": table["compressibility_factor"].value.tolist()}))
"""
FILES = """
import importlib.metadata, os.path, sys
files = [file.locate() for file in importlib.metadata.files("vitrel") if "__pycache__" not in str(file)]
print(*(os.path.relpath(file, sys.prefix) for file in files), sep="\\n")
"""


def copy_sources(root):
    """A clone of the sources in the system, without what is not committed; its commit."""
    output_of(["git", "clone", "--quiet", "--no-hardlinks", ROOT, root / "root/vitrel"])
    return output_of(["git", "-C", ROOT, "rev-parse", "HEAD"]).strip()


def install_in_environment(root, name, source):
    """Installs this source in a new virtual environment."""
    inside(root, f"python3 -m venv --system-site-packages {name} && {name}/bin/{PIP} {source}", PIP_NO_INDEX="1")


def work_in_environment(root, name):
    """What the package says and computes there."""
    (root / "root/work.py").write_text(WORK, encoding="utf-8")
    found = json.loads(inside(root, f"{name}/bin/python3 work.py {name}-work"))
    expect(found["distribution"] == found["version"], f"dist-info is of version {found['distribution']}")
    expect(found["sweep"] == [0.3, 0.4], f"the sweep has the packing fractions {found['sweep']}")
    expect(inside(root, f"{name}/bin/vitrel version").strip() == found["version"], "the program has another version")
    return found


def files_of(root, name):
    """The files of the distribution, relative to the virtual environment."""
    return sorted(inside(root, f"{name}/bin/python3 -c {shlex.quote(FILES)}").splitlines())


def check_places(files, version):
    """In site-packages is the whole package with its metadata and nothing else; beside it are the program and its texts.
    Returns the program and the module.
    """
    site = re.compile(r"lib/python3\.\d+/site-packages/")
    packaged = {site.sub("", file) for file in files if site.match(file)}
    package = {name for name in packaged if not name.startswith(f"vitrel-{version}.dist-info/")}
    compiled = {name for name in package if re.fullmatch(r"vitrel/_vitrel\.cpython-3\d+-[\w-]+\.so", name)}
    sources = {f"vitrel/{file.name}" for file in (ROOT / "python/vitrel").iterdir() if file.is_file()}
    expect(len(compiled) == 1 and package == sources | compiled, f"in site-packages: {', '.join(sorted(package))}")
    beside = [file for file in files if not site.match(file)]
    expect("bin/vitrel" in beside and "share/man/man1/vitrel.1" in beside, f"beside site-packages: {', '.join(beside)}")
    expect(all(re.match("bin/vitrel$|share/", file) for file in beside), f"beside site-packages: {', '.join(beside)}")
    return ["bin/vitrel", next(file for file in files if file.endswith(".so"))]


def check_program(root, file):
    """It is for every processor, and the dynamic linker looks for its libraries where those of the system are."""
    expect("%ymm" not in inside(root, f"objdump --disassemble {file}"), f"{file} has instructions of newer processors")
    expect(not re.search(r"R(UN)?PATH", inside(root, f"readelf --dynamic {file}")), f"{file} names folders of libraries")


def check_removal(root, name):
    inside(root, f"{name}/bin/pip uninstall --quiet --yes vitrel")
    left = inside(root, f"find {name} -type f -path '*vitrel*'").split()
    expect(not left, f"left behind: {', '.join(left)}")


def measure(_):
    require_root()
    with bare_system(SUITE) as root:
        commit = copy_sources(root)
        return check(root, commit)


def check(root, commit):
    """The section of the page for the sources of this commit in the system."""
    dependencies = timed(inside, root, "vitrel/scripts/install_dependencies build python wheel")
    load = os.getloadavg()[0]
    seconds = timed(install_in_environment, root, "checkout", "./vitrel")
    inside(root, "cd vitrel && python3 -m build --sdist --no-isolation --outdir ../dist")
    install_in_environment(root, "unpacked", "dist/vitrel-*.tar.gz")

    found = {name: work_in_environment(root, name) for name in ("checkout", "unpacked")}
    expect(found["checkout"] == found["unpacked"], f"the source distribution builds something else: {found}")
    expect(found["checkout"]["commit"] == commit, f"the package is of commit {found['checkout']['commit']}")
    files = files_of(root, "checkout")
    expect(files == files_of(root, "unpacked"), "the source distribution installs other files")
    binaries = [f"checkout/{file}" for file in check_places(files, found["checkout"]["version"])]
    for file in binaries:
        check_program(root, file)
    measured = [*(root / "root" / file for file in binaries), *(root / "root/dist").iterdir()]
    sizes = [(f"`{file.name}`", f"{file.stat().st_size / 1e6:.2f}") for file in measured]
    check_removal(root, "checkout")
    return {"dependencies": dependencies, "seconds": seconds, "load": load, "processors": os.cpu_count(),
            "table": table(["file", "MB"], sizes)}
