"""What lies beside an installed program is what it prints itself, and bash completes with it."""
import pathlib
import subprocess
import sys

prefix = pathlib.Path(sys.argv[1])
program = prefix / "bin" / "vitrel"


def output(*words):
    return subprocess.run(words, check=True, capture_output=True, text=True).stdout


for file, words in {"man/man1/vitrel.1": ["man"],
                    "bash-completion/completions/vitrel": ["completion", "bash"],
                    "zsh/*/_vitrel": ["completion", "zsh"]}.items():
    text = next((prefix / "share").glob(file)).read_text(encoding="utf-8")
    assert text == output(program, *words), file
    assert "export" in text, file

script = 'source "$0"; COMP_WORDS=(vitrel expo); COMP_CWORD=1; _vitrel; echo "${COMPREPLY[@]}"'
completion = prefix / "share/bash-completion/completions/vitrel"
assert output("bash", "-c", script, completion) == "export\n"
