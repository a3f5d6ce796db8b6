"""A run is read by all commands while another process writes it, copied slowly, killed, and continued."""
import json
import pathlib
import signal
import subprocess
import time

from program import PROGRAM, vitrel, work_in_a_new_folder

PARAMETERS = """[system]
particles = 100
packing_fraction = 0.5
[[species]]
aspect_ratio = 2
[dynamics]
duration = 1e7
[output]
samples = { spacing = "linear", interval = 10 }
"""


def read(*words):
    """What the command prints as JSON; it must say up to where it has read."""
    done = vitrel(*words, "--json")
    assert done.returncode == 0, (words, done.stderr)
    summary = json.loads(done.stdout)
    assert "another process is writing it; read up to the time" in summary["import"]["in progress"], summary
    return summary


def has_frames(count):
    """A file that has just appeared has none, which `check` says."""
    if not pathlib.Path("run.h5").exists():
        return False
    if "has no frame to check" in vitrel("check", "run.h5", "--json").stderr:
        return False
    return read("check", "run.h5")["frames"] >= count


def wait_for_frames(count):
    while not has_frames(count):
        time.sleep(0.1)


def copy_slowly():
    with open("run.h5", "rb") as source, open("copy.h5", "wb") as target:
        while part := source.read(1 << 20):
            target.write(part)
            time.sleep(0.02)


def looked_at():
    wait_for_frames(20)
    frames = [read("check", "run.h5")["frames"] for _ in range(5)]
    assert frames == sorted(frames), frames
    assert read("analyze", "run.h5", "-o", "results.h5")["output"] == "results.h5"
    read("export", "run.h5", "--to", "xyz", "-o", "early.xyz")
    done = vitrel("report", "run.h5", "-o", "page.html")
    assert done.returncode == 0, done.stderr
    assert "another process is writing it" in pathlib.Path("page.html").read_text(encoding="utf-8")


def copied():
    for _ in range(3):
        copy_slowly()
        done = vitrel("check", "copy.h5")
        refused = done.returncode == 3 and "it was copied while another process wrote it" in done.stderr
        assert done.returncode == 0 or refused, done.stderr


def killed():
    before = read("check", "run.h5")["frames"]
    writer.send_signal(signal.SIGKILL)
    writer.wait()
    done = vitrel("check", "run.h5", "--json")
    assert done.returncode == 0, done.stderr
    summary = json.loads(done.stdout)
    assert "import" not in summary and summary["frames"] >= before, summary
    assert vitrel("export", "run.h5", "--to", "xyz", "-o", "late.xyz").returncode == 0
    early = pathlib.Path("early.xyz").read_text(encoding="utf-8")
    late = pathlib.Path("late.xyz").read_text(encoding="utf-8")
    assert late.startswith(early) and len(late) > len(early)
    continued = vitrel("run", "run.toml", "-o", "run.h5", "--wall-time", "1")
    assert continued.returncode == 5, continued.stderr
    assert vitrel("check", "run.h5").returncode == 0


with work_in_a_new_folder():
    pathlib.Path("run.toml").write_text(PARAMETERS, encoding="utf-8")
    # Until it is killed.
    with subprocess.Popen([PROGRAM, "run", "run.toml", "-o", "run.h5", "-q"]) as writer:
        try:
            looked_at()
            copied()
            killed()
        finally:
            writer.kill()
