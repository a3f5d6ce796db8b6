"""`scripts/container` made the image in {seconds:.0f} s (buildah, isolation `chroot`). It takes {size} and has no
compiler. `vitrel --version` says {version}; a run of an example passes the exact check and names the commit.
"""

import json
import subprocess
import tempfile

from validation.bare_system import require_root, timed
from validation.common import ROOT, expect, output_of, settings

TITLE = "In a container"
INPUTS = ["CMakeLists.txt", "Containerfile", "cmake", "scripts/container"]


def in_container(container, *command):
    """The standard output of a command in the container."""
    return output_of(["buildah", "run", "--isolation", "chroot", container, "--", *command])


def measure(_):
    require_root()
    with tempfile.TemporaryDirectory() as folder:
        output_of(["git", "clone", "--quiet", "--no-hardlinks", ROOT, folder])
        commit = output_of(["git", "-C", folder, "rev-parse", "HEAD"]).strip()
        seconds = timed(output_of, [f"{folder}/scripts/container"])
    container = output_of(["buildah", "from", "localhost/vitrel"]).strip()
    try:
        return check(container, commit, seconds)
    finally:
        subprocess.run(["buildah", "rm", container], check=True, capture_output=True)


def check(container, commit, seconds):
    """The section of the page for a container of the image."""
    version = in_container(container, "vitrel", "--version").strip()
    missing = in_container(container, "sh", "-c", "! command -v c++ cmake git")
    expect(missing == "", f"the image has {missing}")
    in_container(container, "vitrel", "run", "/usr/share/doc/vitrel/examples/thesis.toml", "-o", "/run.h5", "--quiet",
                 *settings(["system.particles=50", "dynamics.duration=10"]))
    summary = json.loads(in_container(container, "vitrel", "check", "/run.h5", "--json"))
    expect(summary["overlaps"] == 0, "the run has overlaps")
    expect(commit in in_container(container, "grep", "-a", "-o", commit, "/run.h5"), "the run is of another commit")
    size = json.loads(output_of(["buildah", "images", "--json", "localhost/vitrel"]))[0]["size"]
    return {"seconds": seconds, "size": size, "version": version}
