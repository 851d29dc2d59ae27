#!/usr/bin/python3
"""Checks the shipped configurations and a fresh result against the published schemas, with another validator than the program's own.

    scripts/check_schemas.py PROGRAM      PROGRAM: build/release/manylights

Also checks that each schema refuses what it must: a document with an unknown key. Needs Debian's python3-jsonschema.
Exit code 0: all as it should be; 1: something is not; 3: the program could not be run.
"""

import copy
import json
import pathlib
import subprocess
import sys
import tempfile

import jsonschema

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCHEMAS = ROOT / "results" / "schema"


def read(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def violations(schema, document):
    errors = jsonschema.Draft7Validator(schema).iter_errors(document)
    return [f"$.{'.'.join(str(step) for step in error.absolute_path)}: {error.message[:200]}" for error in errors]


def check(name, schema, document):
    """The faults of a document that must be valid, and whose copy with an unknown key must not be."""
    faults = [f"{name}: {violation}" for violation in violations(schema, document)]
    spoilt = copy.deepcopy(document)
    spoilt["no_such_key"] = 1
    if not violations(schema, spoilt):
        faults.append(f"{name}: the schema accepts an unknown key")
    return faults


def smoke_result(program):
    with tempfile.TemporaryDirectory() as folder:
        smoke = ROOT / "configs" / "regression" / "smoke.json"
        command = [program, "run", str(smoke), "--out", folder, "--quiet"]
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            print(f"check_schemas: {' '.join(command)}: exit code {done.returncode}: {done.stderr.strip()}", file=sys.stderr)
            sys.exit(3)
        return read(pathlib.Path(folder) / "result.json")


def main():
    if len(sys.argv) != 2:
        print("usage: check_schemas.py PROGRAM", file=sys.stderr)
        return 2
    config_schema = read(SCHEMAS / "config.schema.json")
    result_schema = read(SCHEMAS / "result.schema.json")
    for schema in (config_schema, result_schema):
        jsonschema.Draft7Validator.check_schema(schema)
    configs = sorted((ROOT / "configs").rglob("*.json"))
    faults = [] if configs else ["configs: no configuration found"]
    for config in configs:
        faults += check(config.relative_to(ROOT), config_schema, read(config))
    result = smoke_result(sys.argv[1])
    faults += check("result of configs/regression/smoke.json", result_schema, result)
    if not (result["complete"] and result["cases"]):
        faults.append("result of configs/regression/smoke.json: not complete")
    print("\n".join(faults) or f"{len(configs)} configurations and a result of {len(result['cases'])} cases are valid")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
