"""vitrel built and tried in bare systems with other compilers and libraries: rewrites docs/platforms.md.

Each part is one system. What is measured there is kept in docs/data/platforms, a file for each compiler, and the page
is written from these files; the part "page" only writes it. Results are compared with those of Debian 12 and its GCC,
which stay in build/platforms, as do the logs. Sources are those of the last commit.
"""

import dataclasses
import datetime
import hashlib
import json
import os
import re
import shutil
import subprocess
import time
import zipfile

from validation.bare_system import ENVIRONMENT, bare_system, inside, install, require_root, timed, words_inside
from validation.common import ROOT, Failure, expect, expect_chart, output_of, processor
from validation.platforms_page import page, problems

TITLE = "Platforms"
STANDS_ALONE = True
DATA = ROOT / "docs/data/platforms"
PAGE = ROOT / "docs/platforms.md"
WORK = ROOT / "build/platforms"
TABLES_WITHIN = "1e-12"  # relative to the largest number of a dataset; trajectories have the same bits
SHOWN = 10  # lines of a failure, and results that differ

VERSIONS = {"CMake": "cmake", "HDF5": "libhdf5-dev", "Eigen": "libeigen3-dev", "fmt": "libfmt-dev",
            "CLI11": "libcli11-dev", "Python": "python3"}


@dataclasses.dataclass(frozen=True)
class Compiler:
    name: str
    c: str
    cxx: str
    package: str
    tests: str = ""  # "all", "unit" or the folders of tests


@dataclasses.dataclass(frozen=True)
class System:
    name: str
    suite: str
    compilers: tuple


def gcc(tests):
    return Compiler("GCC", "gcc", "g++", "g++", tests)


def clang(version):
    return Compiler("Clang", f"clang-{version}", f"clang++-{version}", f"clang-{version}")


EMULATED_TESTS = ("core", "mc", "edmd", "analysis")
CROSS_GCC = Compiler("GCC", "aarch64-linux-gnu-gcc", "aarch64-linux-gnu-g++", "crossbuild-essential-arm64",
                     ", ".join(EMULATED_TESTS))
SYSTEMS = {"bookworm": System("Debian 12", "bookworm", (gcc("all"), clang(14))),
           "trixie": System("Debian 13", "trixie", (gcc("all"), clang(19))),
           "unstable": System("Debian unstable", "sid", (gcc("unit"), clang(21))),
           "arm64": System("Debian 13, arm64", "trixie", (CROSS_GCC,))}
PARTS = (*SYSTEMS, "page")
REFERENCE = "bookworm-gcc"


# ---- what logs say ----------------------------------------------------------------------------------------

def warnings(log):
    """How many warnings CMake and the compiler gave in a log of both."""
    return {"CMake": len(re.findall(r"^CMake (?:\w+ )?Warning", log, re.MULTILINE)),
            "compiler": len(re.findall(r"\bwarning: ", log))}


def outcome_of_tests(log):
    """What ctest says in the end, or nothing if it did not get there."""
    found = re.search(r"(\d+) tests failed out of (\d+)", log)
    failed = re.findall(r"^\s*\d+ - (\S+) \((?!Disabled|Skipped)\w[\w ]*\)", log, re.MULTILINE)
    left_out = re.findall(r"^-- (Left out: .*)", log, re.MULTILINE)
    return found and {"number": int(found[2]), "failed": failed[:int(found[1])], "left out": left_out}


def differing(comparison):
    """The names of results in the output of scripts/checksums --against."""
    return sorted(set(re.findall(r"^[-+] (.+) [0-9a-f]{16}$", comparison, re.MULTILINE)))


# ---- one compiler in one system ---------------------------------------------------------------------------

class Trial:
    """Has sources of its own and records what was measured."""

    APART = ()  # more options of unshare
    # Before the commands of a step: terminals and shared memory, which end with them.
    FIRST = """mount -t devpts -o newinstance,ptmxmode=0666 devpts /dev/pts
mount --bind /dev/pts/ptmx /dev/ptmx
mount -t tmpfs tmpfs /dev/shm
"""

    def __init__(self, root, name, system, compiler):
        self.root, self.name, self.compiler = root, name, compiler
        self.sources, self.saved = root / "root" / name, root / f"root/{name}.npz"
        output_of(["git", "clone", "--quiet", ROOT, self.sources])
        self.record = {"system": system.name, "compiler": compiler.name, "date": str(datetime.date.today()),
                       "commit": output_of(["git", "-C", self.sources, "rev-parse", "--short", "HEAD"]).strip(),
                       "processor": processor(), "load": round(os.getloadavg()[0], 1), "seconds": {},
                       "warnings": {"CMake": 0, "compiler": 0}}

    def step(self, name, command):
        """Runs a command in the folder of the sources, keeps its time and its output; returns output and exit code."""
        print(f"{self.name}: {name}", flush=True)
        words = words_inside(self.root, f"{self.FIRST}cd {self.name}\n{command}", *self.APART)
        environment = {**ENVIRONMENT, "CC": self.compiler.c, "CXX": self.compiler.cxx}
        start = time.monotonic()
        done = subprocess.run(words, stdin=subprocess.DEVNULL, env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace", check=False)
        self.record["seconds"][name] = round(time.monotonic() - start, 1)
        (WORK / f"{self.name}-{name}.log").write_text(done.stdout, encoding="utf-8")
        return done.stdout, done.returncode

    def must(self, name, command):
        """The output of a step without which the next ones are of no use."""
        output, code = self.step(name, command)
        expect(code == 0, f"{name}: exit code {code}\n{last_lines(output)}")
        return output

    def count_warnings(self, log):
        for kind, number in warnings(log).items():
            self.record["warnings"][kind] += number

    def install(self):
        """The packages of the build, into a system that may have no compiler yet."""
        self.record["seconds"]["packages"] = round(timed(self.install_packages), 1)

    def install_packages(self):
        inside(self.root, f"{self.name}/scripts/install_dependencies build python")
        install(self.root, self.compiler.package)

    def build(self):
        """The demo, from the sources to its page and to the Python package."""
        self.count_warnings(self.must("demo", "scripts/demo"))
        expect_chart(self.sources / "out/demo/report.html")

    def note_versions(self):
        form = "${Package} ${source:Upstream-Version}\\n"
        lines = inside(self.root, f"dpkg-query -W -f '{form}' {' '.join(VERSIONS.values())}").splitlines()
        found = dict(line.split() for line in lines)
        compiler = inside(self.root, f"{self.compiler.cxx} --version")
        self.record["versions"] = {name: re.match(r"[\d.]*\d", found[package])[0] for name, package in VERSIONS.items()}
        self.record["versions"]["compiler"] = re.search(r"\d+\.\d+\.\d+", compiler)[0]

    def compare(self):
        """All results of scripts/checksums with those of the reference, which are kept."""
        self.must("checksums", f"scripts/checksums build/release/app/vitrel --save ../{self.saved.name} -j 2")
        kept = reference(self.sources)
        if self.name == REFERENCE:
            shutil.copy(self.saved, kept)
        shutil.copy(kept, self.root / "root/reference.npz")
        command = f"scripts/checksums ../{self.saved.name} --against ../reference.npz"
        exact, _ = self.step("comparison of bits", command)
        within, code = self.step("comparison", f"{command} --tables-within {TABLES_WITHIN}")
        expect(code in (0, 1), f"comparison: exit code {code}\n{last_lines(within)}")
        different = differing(within)
        with zipfile.ZipFile(self.saved) as saved:
            number = len(saved.namelist())
        self.record["results"] = {"number": number, "other bits": len(differing(exact)), "different": len(different),
                                  "such as": different[:SHOWN]}

    def test(self):
        if self.compiler.tests == "all":
            inside(self.root, f"{self.name}/scripts/install_dependencies test bench manual")
            self.run_tests("scripts/test")
        elif self.compiler.tests == "unit":
            install(self.root, "libgmock-dev", "libgtest-dev")
            self.run_tests("cmake --preset release -DVITREL_BUILD_BENCH=OFF -DVITREL_BUILD_PYTHON=OFF\n"
                           "cmake --build --preset release\nctest --preset release -L unit")

    def run_tests(self, command):
        """Tests that fail do not stop the others."""
        output, code = self.step("tests", command)
        self.count_warnings(output.split("\nTest project ")[0])
        outcome = outcome_of_tests(output)
        expect(outcome, f"tests: exit code {code}\n{last_lines(output)}")
        self.record["tests"] = {"kind": self.compiler.tests, **outcome}


class ArmTrial(Trial):
    """Compiled here for 64-bit ARM. Programs for it run where they are called, by an emulator that nobody else sees:
    binfmt_misc of a user namespace.
    """

    APART = ("--user", "--map-root-user")
    FIRST = """mount -t binfmt_misc none /proc/sys/fs/binfmt_misc
cat /usr/share/qemu/binfmt.d/qemu-aarch64.conf >/proc/sys/fs/binfmt_misc/register
"""

    def install_packages(self):
        inside(self.root, "dpkg --add-architecture arm64 && apt-get update -qq")
        install(self.root, self.compiler.package, "qemu-user", *self.packages())

    def packages(self):
        """Of the libraries those for ARM, unless all processors have the same."""
        listed = output_of([self.sources / "scripts/install_dependencies", "--list", "build"]).split()
        libraries = [name for name in (*listed, "libgmock-dev", "libgtest-dev") if name.endswith("-dev")]
        shown = inside(self.root, f"apt-cache show --no-all-versions {' '.join(libraries)}")
        for_all = re.findall(r"^Package: (.+)\n(?:.+\n)*?Architecture: all\n", shown, re.MULTILINE)
        tools = [name for name in listed if not name.endswith("-dev") and name != "g++"]
        return [*tools, *(name if name in for_all else f"{name}:arm64" for name in libraries)]

    def build(self):
        """The program and the tests that are run."""
        targets = " ".join(["vitrel", *(f"test_{name}" for name in EMULATED_TESTS)])
        self.count_warnings(self.must("build", f"""cmake -S . -B build/release -G Ninja -DCMAKE_SYSTEM_NAME=Linux \
-DCMAKE_SYSTEM_PROCESSOR=aarch64 -DVITREL_BUILD_BENCH=OFF -DVITREL_BUILD_PYTHON=OFF
cmake --build build/release --target {targets}"""))

    def test(self):
        self.run_tests(f"ctest --test-dir build/release -j 2 --output-on-failure -R '^({'|'.join(EMULATED_TESTS)})\\.'")


# ---- all of them ------------------------------------------------------------------------------------------

def last_lines(text):
    return "\n".join(text.splitlines()[-SHOWN:])


def reference(sources):
    """The file of the results to compare with, of sources that compute the same as these."""
    parts = ("app", "analysis", "cmake", "core", "edmd", "mc", "workflow", "tests/scenes", "scripts/checksums")
    trees = output_of(["git", "-C", sources, "rev-parse", *(f"HEAD:{part}" for part in parts)])
    return WORK / f"reference-{hashlib.sha256(trees.encode()).hexdigest()[:12]}.npz"


def tried(trial):
    """The record of all that was measured until something failed."""
    try:
        for step in (trial.install, trial.build):
            step()
        install(trial.root, "python3-h5py")
        for step in (trial.note_versions, trial.compare, trial.test):
            step()
    except Failure as failure:
        trial.record["failure"] = str(failure)
    return trial.record


def measure_system(part):
    system = SYSTEMS[part]
    expect(REFERENCE.startswith(part) or reference(ROOT).exists(),
           "the results of Debian 12 are missing; first run scripts/validate platforms --part bookworm")
    with bare_system(system.suite) as root:
        for compiler in system.compilers:
            name = f"{part}-{compiler.name.lower()}"
            record = tried((ArmTrial if part == "arm64" else Trial)(root, name, system, compiler))
            text = json.dumps(record, indent=1, ensure_ascii=False)
            (DATA / f"{name}.json").write_text(text + "\n", encoding="utf-8")


def records():
    """By system and compiler, in this order, nothing for what was not measured yet."""
    files = {f"{part}-{compiler.name.lower()}": (system, compiler)
             for part, system in SYSTEMS.items() for compiler in system.compilers}
    return [json.loads(file.read_text(encoding="utf-8")) if (file := DATA / f"{name}.json").exists()
            else {"system": system.name, "compiler": compiler.name} for name, (system, compiler) in files.items()]


def measure(_, parts=tuple(SYSTEMS)):
    for folder in (DATA, WORK):
        folder.mkdir(parents=True, exist_ok=True)
    for part in parts:
        if part in SYSTEMS:
            require_root()
            measure_system(part)
    found = records()
    PAGE.write_text(page(found), encoding="utf-8")
    failed = [f"{one['system']}, {one['compiler']}: {problem}" for one in found for problem in problems(one)]
    expect(not failed, "\n".join(failed))
    return f"{PAGE.relative_to(ROOT)} is written"


def status(_):
    return "\n".join(f"{one['system']}, {one['compiler']}: {one.get('date', 'not measured')} {one.get('commit', '')}"
                     for one in records())
