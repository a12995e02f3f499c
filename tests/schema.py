#!/usr/bin/env python3
"""`bulbus schema` accepts every scene and study of this repository, and refuses slips. Exit status 77, skipped, without Debian's
python3-jsonschema and python3-yaml.

    python3 tests/schema.py build/bulbus
"""
import json
import pathlib
import subprocess
import sys

try:
    import jsonschema
    import yaml
except ImportError:
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parent.parent


def schema_of(what):
    done = subprocess.run([sys.argv[1], "schema", what], capture_output=True, text=True, check=True)
    schema = json.loads(done.stdout)
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def main():
    validators = {what: schema_of(what) for what in ("scene", "study")}
    files = [*ROOT.glob("data/scenes/*.yaml"), *ROOT.glob("app/new/*.yaml")]
    kinds = {"scene": 0, "study": 0}
    for file in files:
        content = yaml.safe_load(file.read_text())
        kind = "study" if "vary" in content else "scene"
        kinds[kind] += 1
        faults = list(validators[kind].iter_errors(content))
        assert not faults, f"{file}: {faults[0].json_path}: {faults[0].message}"
    assert kinds["scene"] > 15 and kinds["study"] > 2, kinds
    scene = yaml.safe_load((ROOT / "data/scenes/sphere_liquid.yaml").read_text())
    for slip in ({"titel": "a"}, {"mesh": {}}, {"mesh": {"shell": {"n": "many"}}}, {"solver": {"linear": {"method": "fast"}}}):
        assert not validators["scene"].is_valid({**scene, **slip}), slip
    study = yaml.safe_load((ROOT / "data/scenes/study_sphere.yaml").read_text())
    for slip in ({"design": "random"}, {"vary": [{"name": "a"}]}, {"tolerance": 2}):
        assert not validators["study"].is_valid({**study, **slip}), slip


main()
