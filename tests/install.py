#!/usr/bin/env python3
"""install.py BUILD: the example builds against the installed tree, finds its floors, and converges."""
import os
import pathlib
import subprocess
import sys
import tempfile

EXAMPLE = pathlib.Path(__file__).resolve().parent.parent / "examples/inflated_sphere"


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}: exit status {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def main():
    build = pathlib.Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        prefix, tree = pathlib.Path(folder) / "usr", pathlib.Path(folder) / "build"
        for component in ("program", "development"):
            run("cmake", "--install", build, "--prefix", prefix, "--component", component)
        run("cmake", "-S", EXAMPLE, "-B", tree, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Release")
        run("cmake", "--build", tree)
        said = run(tree / "inflated_sphere")
        assert said.startswith("converged, "), said
        radius = float(said.split()[-2])
        assert 11.1 < radius < 11.3, said  # tests/verify holds the numbers against the closed form
        assert "bulbus" in run(prefix / "bin/bulbus", "--version")
        check = run(prefix / "bin/bulbus", "check", prefix / "share/bulbus/scenes/two_blocks.yaml")
        assert "hexahedra" in check, check
        assert (prefix / "share/bulbus/python/bulbus/__init__.py").exists()
        for made, first in (("bash-completion/completions/bulbus", "# Completion"), ("zsh/site-functions/_bulbus", "#compdef bulbus"),
                            ("man/man1/bulbus.1", ".TH BULBUS 1"), ("bulbus/scene.schema.json", "{"), ("bulbus/study.schema.json", "{")):
            assert (prefix / "share" / made).read_text().startswith(first), made
    print(said.strip())


if __name__ == "__main__":
    main()
