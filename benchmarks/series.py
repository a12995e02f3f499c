"""Records of benchmarks that belong together: those of one commit.

`benchmarks/all --full` writes series.json beside the records: which commit they are of, and which they are. Without that file a folder's
records may be of different commits, and every table says of which.
"""
import json

NAME = "series.json"


def records(folder):
    """Names and contents of a folder's records."""
    return {p.stem: json.loads(p.read_text()) for p in sorted(folder.glob("*.json")) if p.name != NAME}


def write(folder, commit):
    names = sorted(records(folder))
    (folder / NAME).write_text(json.dumps({"commit": commit, "records": names}, indent=1) + "\n")


def faults(folder):
    """Why the records of a folder cannot be published as one series; nothing if they can, or do not claim to be one."""
    path = folder / NAME
    if not path.exists():
        return []
    series, found = json.loads(path.read_text()), records(folder)
    out = [f"{name}: named in {NAME}, but there is no such record" for name in series["records"] if name not in found]
    out += [f"{name}: not named in {NAME}" for name in found if name not in series["records"]]
    for name, record in found.items():
        if record["commit"].endswith("-dirty"):
            out.append(f"{name}: recorded with changes that were not committed ({record['commit']})")
        elif record["commit"] != series["commit"]:
            out.append(f"{name}: of commit {record['commit']}, the series of {series['commit']}")
    return out
