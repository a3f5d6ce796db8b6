"""Runs: the same as from the command line, and what Python adds to them."""

import io
import os
import pickle
import re
import signal
import subprocess
import sys
import textwrap
import time

import h5py
import numpy
import pytest
import vitrel
from vitrel.progress import listener

SMALL = {"particles": 100, "packing_fraction": 0.5, "aspect_ratio": 2, "seed": 3, "prepare__quality_sweeps": 0}


def datasets(path):
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: item[()].tobytes()})
                        if isinstance(item, h5py.Dataset) and not name.startswith("parameters") else None)
    return found


def command_line(program, folder, output):
    (folder / "p.toml").write_text(
        "[system]\nparticles = 100\npacking_fraction = 0.5\nseed = 3\n[[species]]\naspect_ratio = 2\n"
        "[dynamics]\nduration = 5\nequilibration = 0\n", encoding="utf-8")
    subprocess.run([program, "run", folder / "p.toml", "-o", output, "--quiet"], check=True)


class Terminal(io.StringIO):
    def isatty(self):
        return True


def terminal_of(monkeypatch):
    """In the place of stderr; not a fixture, as pytest replaces stderr between its set-up and the test."""
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    return terminal


def test_a_run_is_its_file(tmp_path):
    made = vitrel.run(output=tmp_path / "run.h5", duration=1, equilibration=0, quiet=True, **SMALL)
    with vitrel.load(tmp_path / "run.h5") as run:
        assert run == made and hash(run) == hash(made) and pickle.loads(pickle.dumps(run)) == made
        last = run[-1]
    assert last == made[-1]
    with pytest.raises(vitrel.UserError, match="run.h5 was closed"):
        run[0]


@pytest.mark.parametrize("has_tqdm", [True, False])
def test_progress_is_shown(monkeypatch, has_tqdm):
    terminal = terminal_of(monkeypatch)
    if not has_tqdm:
        monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    say, show, end = listener(quiet=False)
    say("run of disks")
    show(0.25, "time", 12.5)
    assert re.search(r"run of disks.*25.*%.*time 12\.5", terminal.getvalue(), re.DOTALL)
    assert ("| 00:00" in terminal.getvalue()) == has_tqdm
    end.close()


def test_a_terminal_shows_the_steps_of_a_run_unless_it_is_quiet(tmp_path, monkeypatch):
    terminal = terminal_of(monkeypatch)
    vitrel.run(output=tmp_path / "a.h5", duration=1, equilibration=0, **SMALL)
    shown = terminal.getvalue()
    assert "insert at packing fraction" in shown and "run of rotating ellipses" in shown
    terminal.truncate(0)
    vitrel.run(output=tmp_path / "b.h5", duration=1, equilibration=0, quiet=True, **SMALL)
    assert not terminal.getvalue()


def test_a_run_is_that_of_the_command_line(tmp_path, vitrel_program):
    run = vitrel.run(output=tmp_path / "a.h5", duration=5, equilibration=0, **SMALL)
    command_line(vitrel_program, tmp_path, tmp_path / "b.h5")
    assert datasets(tmp_path / "a.h5") == datasets(tmp_path / "b.h5")
    assert run.summary["overlaps"] == 0 and len(run) == len(run.times)
    assert run[-1].position.shape == (100, 2) and run[-1].time == run.times[-1]


def test_a_file_gives_parameters(tmp_path, vitrel_program):
    command_line(vitrel_program, tmp_path, tmp_path / "b.h5")
    vitrel.run(file=tmp_path / "p.toml", output=tmp_path / "c.h5")
    assert datasets(tmp_path / "b.h5") == datasets(tmp_path / "c.h5")


def test_a_complete_run_can_become_longer(tmp_path):
    state = vitrel.prepare(particles=50, packing_fraction=0.4, aspect_ratio=2, quality_sweeps=0)
    settings = {"output": tmp_path / "run.h5", "equilibration": 0, "samples__interval": 0.5}
    assert vitrel.run(state, duration=2, **settings).times[-1] == 2
    assert vitrel.run(state, duration=4, **settings).times[-1] == 4


def nematic(state):
    """Nematic order."""
    return abs(numpy.exp(2j * state.angle).mean())


def test_observables_take_part_in_a_run_and_in_its_analysis(tmp_path):
    seen = []
    run = vitrel.run(output=tmp_path / "run.h5", duration=20, equilibration=0, on_frame=seen.append,
                     observe={"order": nematic, "centre": lambda state: state.unwrapped.mean(axis=0)}, **SMALL)
    assert [state.time for state in seen] == run.times.tolist()
    assert (seen[3].position == run[3].position).all()
    table = run.observed["order"]
    assert table["time"].value.tolist() == run.times.tolist() and table.description == "Nematic order."
    assert table["order"].value.tolist() == [nematic(state) for state in run]
    assert run.observed.summary["order"] == pytest.approx(table["order"].value.mean())
    assert run.observed.summary["order_error"] > 0
    assert list(run.observed["centre"]) == ["time", "centre_0", "centre_1"]
    again = run.analyze(observe={"order": nematic})
    assert again["order"]["order"].value.tolist() == table["order"].value.tolist()
    assert again.summary["order_error"] == run.observed.summary["order_error"] and "msd" in again["displacements_all"]


def test_an_error_of_a_callback_ends_the_run_which_can_continue(tmp_path):
    class Enough(Exception):
        pass

    def stop(state):
        if state.time > 1:
            raise Enough("at one")

    settings = {"output": tmp_path / "run.h5", "duration": 4, "equilibration": 0, "samples__interval": 0.5, **SMALL}
    with pytest.raises(Enough, match="at one"):
        vitrel.run(on_frame=stop, **settings)
    run = vitrel.run(observe={"order": nematic}, **settings)
    assert run.observed["order"]["time"].value.tolist() == [0.5 * k for k in range(9)]


def test_observables_of_changing_shape_are_refused(tmp_path):
    with pytest.raises(vitrel.UserError, match="'several' has"):
        vitrel.run(output=tmp_path / "run.h5", duration=1, equilibration=0,
                   observe={"several": lambda state: [0] * (1 + (state.time > 0))}, **SMALL)
    with pytest.raises(vitrel.UserError, match="2 dimensions"):
        vitrel.run(output=tmp_path / "other.h5", duration=1, equilibration=0,
                   observe={"all": lambda state: state.position}, **SMALL)


LONG_RUN = (
    "vitrel.run(output=sys.argv[1], particles=200, packing_fraction=0.6, aspect_ratio=2, equilibration=0,\n"
    "           prepare__quality_sweeps=0, duration={}, samples__interval=0.01, quiet=True{})\n")


def interrupted(path, before, work, begins):
    """What a script prints that is interrupted at work, after the line that begins like this."""
    script = ("import sys, vitrel\n" + before +
              "try:\n" + textwrap.indent(work, "    ") +
              "except KeyboardInterrupt:\n    print('interrupted', flush=True)\n")
    process = subprocess.Popen([sys.executable, "-c", script, path], stdout=subprocess.PIPE, text=True)
    while not process.stdout.readline().startswith(begins):
        assert process.poll() is None
    time.sleep(0.2)
    process.send_signal(signal.SIGINT)
    printed = process.stdout.read().splitlines()
    assert process.wait() == 0
    return printed


def test_control_c_stops_at_a_checkpoint(tmp_path):
    run = ("vitrel.run(output=sys.argv[1], particles=100, packing_fraction=0.5, aspect_ratio=2, duration=1e6,\n"
           "           prepare__quality_sweeps=0, on_frame=lambda state: print(state.time, flush=True))\n")
    assert interrupted(tmp_path / "run.h5", "", run, "0")[-1] == "interrupted"
    assert (tmp_path / "run.h5.checkpoint").exists()


def test_control_c_stops_an_analysis(tmp_path):
    before = LONG_RUN.format(30, "") + "print('begins', flush=True)\n"
    analyses = "while True:\n    vitrel.load(sys.argv[1]).analyze()\n"
    assert interrupted(tmp_path / "run.h5", before, analyses, "begins") == ["interrupted"]


@pytest.mark.parametrize("work", [
    LONG_RUN.format(1e6, ""),
    LONG_RUN.format(1e6, ", on_frame=lambda state: None"),
    "while True:\n"
    "    state.check()\n"])
def test_threads_at_work_end_with_the_interpreter(tmp_path, work):
    script = ("import sys, threading, time, vitrel\n"
              "state = vitrel.prepare(particles=500, packing_fraction=0.3, stage=[{'method': 'insert'}], quiet=True)\n"
              "def work():\n"
              + textwrap.indent(work, "    ") +
              "threading.Thread(target=work, daemon=True).start()\n"
              "time.sleep(0.5)\n"
              "print('ends', flush=True)\n")
    done = subprocess.run([sys.executable, "-c", script, tmp_path / "run.h5"], capture_output=True, text=True,
                          timeout=300, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "ends\n", "")


def test_other_threads_go_on_meanwhile(tmp_path):
    import threading

    ticks = []
    running = threading.Event()
    running.set()

    def tick():
        while running.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    vitrel.run(output=tmp_path / "run.h5", duration=50, equilibration=0, **SMALL)
    running.clear()
    thread.join()
    assert len(ticks) > 10


def test_mistakes_are_those_of_the_program(tmp_path):
    with pytest.raises(vitrel.UserError, match="packing_fraction"):
        vitrel.prepare(particles=10, packing_fraction=2.0, aspect_ratio=1)
    with pytest.raises(vitrel.UserError, match="kind is \"gas\", but must be one of"):
        vitrel.run(output=tmp_path / "x.h5", kind="gas")
    with pytest.raises(vitrel.FileError, match="missing"):
        vitrel.load(tmp_path / "missing.h5")
    assert os.listdir(tmp_path) == []


def test_frames_are_a_sequence(tmp_path):
    run = vitrel.run(output=tmp_path / "run.h5", duration=5, equilibration=0, **SMALL)
    assert len(run[0:3]) == 3 and [state.time for state in run[::10]] == run.times[::10].tolist()
    assert run[numpy.int64(2)] == run[2] == run[:5][2] == run[4:1:-1][-1]
    with pytest.raises(IndexError):
        run[len(run)]
    with pytest.raises(TypeError):
        run[1.5]


def loaded(file, program):
    """The run, as soon as the program has begun to write it."""
    while True:
        try:
            return vitrel.load(file)
        except vitrel.FileError:
            assert program.poll() in (None, 0)
            time.sleep(0.01)


def test_a_run_is_seen_while_it_is_written(tmp_path, vitrel_program):
    file = tmp_path / "run.h5"
    (tmp_path / "p.toml").write_text("[system]\nparticles = 1000\n[prepare]\nquality_sweeps = 0\n"
                                     "[dynamics]\nduration = 200\nequilibration = 0\n", encoding="utf-8")
    with subprocess.Popen([vitrel_program, "run", tmp_path / "p.toml", "-o", file, "-q"]) as program:
        seen = list(loaded(file, program).live(interval=0.01))
    lengths = [len(run) for run in seen]
    assert lengths == sorted(lengths) and lengths[-1] == 201 and not seen[-1].imported
    assert [len(run) for run in seen[-1].live()] == [201]


def test_runs_are_pickled_by_their_path(tmp_path):
    run = vitrel.run(output=tmp_path / "run.h5", duration=5, equilibration=0, **SMALL)
    copy = pickle.loads(pickle.dumps(run))
    assert copy == run and copy.summary == run.summary and copy[-1] == run[-1]
    results = pickle.loads(pickle.dumps(run.results))
    assert results["displacements_all"]["msd"].value.tolist() == run.msd.value.tolist()


def test_names_of_tables_and_columns_are_completed(tmp_path):
    run = vitrel.load(vitrel.run(output=tmp_path / "run.h5", duration=5, equilibration=0, **SMALL).path)
    assert {"msd", "msr"} <= set(dir(run)) and "results" not in vars(run)
    assert run.msd is not None and {"displacements_all", "msd"} <= set(dir(run))
    assert "displacements_all" in run.results._ipython_key_completions_()


def test_runs_are_exported_and_filmed(tmp_path):
    run = vitrel.run(output=tmp_path / "run.h5", duration=2, equilibration=0, **SMALL)
    assert len(vitrel.load(run.export(tmp_path / "run.gsd", frames="::2"))) == len(run[::2])
    assert run.film(tmp_path / "last.png", "psi6", width=200).read_bytes().startswith(b"\x89PNG")
