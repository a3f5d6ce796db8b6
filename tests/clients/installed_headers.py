"""Every header that an installed one includes is installed, too."""
import pathlib
import re
import sys

ROOMS = "core|mc|edmd|analysis|workflow"
include = next(pathlib.Path(sys.argv[1]).glob("**/core/error.h")).parents[1]
headers = sorted(include.rglob("*.h"))
assert len(headers) > 150, headers
missing = [f"{header.relative_to(include)} includes {name}" for header in headers
           for name in re.findall(rf'#include "((?:{ROOMS})/[^"]+)"', header.read_text(encoding="utf-8"))
           if not (include / name).exists()]
assert not missing, "\n".join(missing)
