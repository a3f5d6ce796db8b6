"""Extreme values of every key: each is refused with one message, or runs, or is stopped after its time; nothing crashes, and
no hard particles overlap."""
import concurrent.futures
import pathlib
import re
import subprocess
import tempfile

from program import PROGRAM, vitrel

VALUES = ["-1", "0", "1e-300", "1e-19", "1e19", "1e300", "nan"]
UNITS = {"radius": "m", "density": "kg/m^3", "thermal_speed": "m/s", "stiffness": "N/m", "damping": "kg/s",
         "youngs_modulus": "Pa", "dissipative_time": "s"}
SCENE = """[system]
particles = 12
packing_fraction = 0.3
[[species]]
aspect_ratio = {aspect}
[[prepare.stage]]
method = "insert"
packing_fraction = 0.1
[[prepare.stage]]
method = "{method}"
[dynamics]
kind = "{kind}"
duration = 1
equilibration = 0
{dynamics}
[output]
samples = {{ {samples} }}
{contact}
"""


def keys():
    """The keys that hold numbers, by the reference page; of lists those of the first entry, of stages of the second."""
    section = ""
    for line in vitrel("params", "--reference").stdout.splitlines():
        if heading := re.match(r"## `\[+(.*?)\]+`", line):
            section = heading[1]
        elif (row := re.match(r"\| `(\S+)` \| (.*?) \|", line)) and not section.startswith(("sweep", "import")):
            key = f"{section}.{row[1]}"
            if not re.match(r'`("|true|false)', row[2]) or row[1] in UNITS:
                yield re.sub(r"^species\.|stage\.|pair\.|material\.",
                             lambda found: found[0] + ("1." if found[0] == "stage." else "0."), key)


def scenes(key):
    """The scenes in which the key has a meaning."""
    contact = [""]
    if ".contact." in key:
        contact = [f'[dynamics.contact]\nlaw = "{law}"' for law in ("linear_dashpot", "viscoelastic")]
    methods = ["grow", "compress", "hybrid", "swell", "sample"] if "stage" in key else ["grow"]
    samples = 'spacing = "linear", interval = 0.1'
    if key.endswith(("samples.first", "samples.per_decade")):
        samples = 'spacing = "logarithmic", first = 0.01, per_decade = 5'
    return [SCENE.format(method=method, contact=law, samples=samples, aspect=1 if law else 2,
                         kind="brownian" if "brownian" in key else "newtonian",
                         dynamics="driving = { interval = 0.1, power = 1 }" if "driving." in key else "")
            for method in methods for law in contact]


def with_unit(key, value):
    unit = UNITS.get(key.split(".")[-1])
    return f'"{value} {unit}"' if unit and ".contact." in key and value != "[]" else value


def complaint(trial):
    """What is wrong with what the program makes of it; nothing if all is well."""
    key, value, scene = trial
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "p.toml").write_text(scene, encoding="utf-8")
        words = [PROGRAM, "run", "p.toml", "-o", "run.h5", "-q", "--wall-time", "0.5", "--set", f"{key}={value}"]
        done = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)
    refused = done.returncode == 2 and re.fullmatch(r"vitrel run: .*\n", done.stderr)
    collapsed = done.returncode == 4 and "restitution" in key and "inelastic collapse" in done.stderr
    if done.returncode in (0, 5) or refused or collapsed:
        return None
    return f"{key} = {value}: exit code {done.returncode}\n{done.stderr}\n{scene}"


trials = [(key, with_unit(key, value), scene) for key in keys() for scene in scenes(key) for value in VALUES]
assert len(trials) > 500
with concurrent.futures.ThreadPoolExecutor(2) as pool:
    found = [text for text in pool.map(complaint, trials) if text]
assert not found, f"{len(found)} of {len(trials)}:\n" + "\n".join(found[:5])
