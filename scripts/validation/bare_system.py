"""Debian systems that have only what apt needs, in folders of their own.

Needs root, but no mount and no process outlives a command: every command in a system has namespaces of its own.
"""

import contextlib
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

from validation.common import expect, output_of

APART = ["unshare", "--mount", "--pid", "--fork", "--kill-child", "--mount-proc"]
ENVIRONMENT = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LC_ALL": "C.UTF-8",
               "DEBIAN_FRONTEND": "noninteractive"}


def require_root():
    expect(os.geteuid() == 0, "needs root, to install packages in a system of its own")


def lines_of(command):
    return output_of(command).splitlines()


def archives():
    """What this machine has for archives of Debian, as lines of sources.list by release."""
    form = "$(RELEASE) deb $(REPO_URI) $(RELEASE) $(COMPONENT)"
    found = lines_of(["apt-get", "indextargets", "Created-By: Packages", "Origin: Debian", "--format", form])
    return dict(line.split(maxsplit=1) for line in found)


def sources(suite):
    """The mirror and the lines of sources.list for a release: those of this machine if it has the same, else one from
    the same mirror, which may keep a state longer than that says it is valid.
    """
    own = archives()
    mirror = next((line.split()[1] for release, line in own.items() if "-" not in release), None)
    expect(mirror, "apt has no archive of Debian; run apt-get update")
    lines = [line for release, line in own.items() if release.split("-")[0] == suite]
    return mirror, lines or [f"deb [check-valid-until=no] {mirror} {suite} main"]


def install_bare_system(root, suite):
    """A Debian without anything more than apt needs, with the archives of this machine and how apt gets there."""
    mirror, lines = sources(suite)
    output_of([*APART, "debootstrap", "--variant=minbase", suite, root, mirror])
    (root / "etc/apt/sources.list").write_text("\n".join(lines) + "\n", encoding="utf-8")
    settings = [line for line in lines_of(["apt-config", "dump"]) if line.startswith("Acquire::")]
    (root / "etc/apt/apt.conf.d/99host").write_text("\n".join(settings) + "\n", encoding="utf-8")
    shutil.copy("/etc/resolv.conf", root / "etc/resolv.conf")
    inside(root, "apt-get update -qq")


@contextlib.contextmanager
def bare_system(suite):
    """The folder of such a system, which is removed in the end, also when the validation is stopped."""
    def stop(number, _):
        raise SystemExit(128 + number)

    before = signal.signal(signal.SIGTERM, stop)
    folder = pathlib.Path(tempfile.mkdtemp(prefix=f"vitrel-{suite}-"))
    try:
        root = folder / "root"
        install_bare_system(root, suite)
        yield root
    finally:
        subprocess.run(["rm", "-rf", "--one-file-system", folder], check=True)
        signal.signal(signal.SIGTERM, before)


def words_inside(root, command, *options):
    """The words of this machine that run a shell command in the system, with more options of unshare."""
    return [*APART, *options, f"--root={root}", "--wd=/root", "sh", "-euc", command]


def inside(root, command, **variables):
    """The standard output of a shell command in the system."""
    return output_of(words_inside(root, command), env={**ENVIRONMENT, **variables}, stdin=subprocess.DEVNULL)


def install(root, *names):
    """Packages of the release that are in /root, and others of the distribution."""
    inside(root, f"apt-get install -qq --no-install-recommends -o Dpkg::Use-Pty=0 {' '.join(names)}")


def timed(work, *arguments):
    start = time.monotonic()
    work(*arguments)
    return time.monotonic() - start
