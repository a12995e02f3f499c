#!/usr/bin/env python3
"""Markdown tables from the JSON files of the benchmarks.

    tables.py [FILE ...]    prints them; default: every file of results/ beside this script
    tables.py --write       puts those of results/ into README.md and docs/benchmarks.md, and docs/trade.csv into docs/trade.md, between
                            their markers
    tables.py --check       fails if the pages say anything else, or if records that claim to be one series (series.py) are of different
                            commits or of changes that were not committed
"""
import csv
import json
import pathlib
import sys

import answers
import series

HERE = pathlib.Path(__file__).resolve().parent

TRADE = [("parameter", "parameter"), ("value", "value"), ("s", "seconds"), ("Newton", "newton"), ("Krylov", "krylov"), ("MB", "mb"),
         ("error, %", "error"), ("in", "error_in"), ("front", "front"), ("error against extrapolated, %", "whole"), ("front", "whole_front")]

# program -> list of tables; a table: where its rows are, its columns as (heading, key)
TABLES = {
    "apply": [("rows", [("tangent by", "variant"), ("hexahedra", "hexahedra"), ("ns per hexahedron", "ns_per_hex"),
                        ("of 3×3 BCSR", "to_bcsr"), ("stored bytes per hexahedron", "stored_bytes_per_hex"),
                        ("GB/s", "gb_per_s"), ("of triad", "of_triad"), ("of FMA peak", "of_fma_peak")])],
    "precond": [("rows", [("n", "n"), ("unknowns", "unknowns"), ("displacement block by", "displacement"),
                          ("iterations", "iterations"), ("set-up s", "setup_s"), ("solve s", "solve_s"), ("MB", "mb"),
                          ("failure", "reason")])],
    "direct_vs_iterative": [
        ("rows", [("n", "n"), ("unknowns", "unknowns"), ("solver", "method"), ("ordering", "ordering"), ("linear solves", "linear_solves"),
                  ("Krylov iterations", "krylov"), ("analysis s", "analysis_s"), ("set-up s", "setup_s"), ("solve s", "solve_s"),
                  ("linear solve s", "linear_s"), ("the same by the clock, s", "wall_s"), ("whole run s", "total_s"), ("peak MB", "peak_mb"),
                  ("factor MB", "memory_mb.factor"), ("factor entries", "factor_entries"), ("Gflop", "gflop"),
                  ("estimated MB", "estimated_mb"), ("estimated Gflop", "estimated_gflop"), ("residual", "reduction"),
                  ("pivots not positive", "nonpositive"), ("failure", "reason")]),
        ("ratios", [("n", "n"), ("unknowns", "unknowns"), ("direct solver", "method"), ("direct's figures", "direct"), ("linear solve, iterative/direct", "linear_s"),
                    ("whole run", "total_s"), ("peak memory", "peak_mb")]),
        ("growth", [("solver", "method"), ("powers of the unknowns, from n", "from_n"), ("set-up", "setup_s"), ("solve", "solve_s"),
                    ("linear solve", "linear_s"), ("whole run", "total_s"), ("peak memory", "peak_mb"),
                    ("estimated memory", "estimated_mb"), ("estimated operations", "estimated_gflop")])],
    "formulations": [
        ("rows", [("n", "n"), ("solver", "method"), ("formulation", "formulation"), ("wet unknowns", "wet_unknowns"),
                  ("numbers of the liquid", "liquid_entries"), ("matrix, entries", "matrix_entries"), ("factors, entries", "factor_entries"),
                  ("estimated MB", "estimated_mb"), ("MB", "mb"), ("process peak MB", "peak_mb"), ("Gflop", "gflop"),
                  ("set-up s", "setup_s"), ("solve s", "solve_s"), ("iterations", "iterations"), ("residual", "reduction"),
                  ("negative pivots", "negative_pivots"), ("difference", "difference"), ("failure", "reason")]),
        ("runs", [("n", "n"), ("solver", "method"), ("formulation", "formulation"), ("increments", "increments"),
                  ("Newton iterations", "newton_iterations"), ("Krylov iterations", "krylov_iterations"), ("set-up s", "setup_s"),
                  ("solve s", "solve_s"), ("whole run s", "total_s"), ("peak MB", "peak_mb"), ("pressure, mmHg", "pressure_mmhg"),
                  ("difference", "difference"), ("failure", "reason")])],
    "operation": [
        ("rows", [("solver", "method"), ("hexahedra", "hexahedra"), ("unknowns", "unknowns"), ("processor minutes", "cpu_min"),
                  ("wall minutes", "wall_min"), ("peak MB", "peak_mb"), ("increments", "increments"), ("cuts", "cuts"),
                  ("Newton iterations", "newton_iterations"), ("Krylov iterations", "krylov_iterations"), ("failure", "reason")]),
        ("probes", [("probe", "probe"), ("unit", "unit"), ("iterative", "iterative"), ("direct", "direct"),
                    ("relative difference", "relative")])],
    "features": [
        ("rows", [("scene", "scene"), ("n", "n"), ("hexahedra", "hexahedra"), ("unknowns", "unknowns"), ("processor minutes", "cpu_min"),
                  ("peak MB", "peak_mb"), ("Newton iterations", "newton_iterations"), ("Krylov iterations", "krylov_iterations"),
                  ("residual ms", "residual_ms"), ("linearisation ms", "linearisation_ms"), ("set-up ms", "setup_ms"),
                  ("ms per Krylov iteration", "krylov_ms"), ("failure", "reason")]),
        ("probes", [("scene", "scene"), ("probe", "probe"), ("unit", "unit"), ("deformable lens", "deformable"), ("rigid lens", "rigid"),
                    ("relative difference", "relative")])],
    "from_dump": [("rows", [("file", "file"), ("unknowns", "unknowns"), ("method", "method"), ("iterations", "iterations"),
                            ("set-up s", "setup_s"), ("solve s", "solve_s"), ("MB", "mb"), ("residual", "residual"),
                            ("failure", "reason")])],
    "apply_ranks": [("rows", [("tangent by", "variant"), ("hexahedra", "hexahedra"), ("ms", "ms"), ("independent copies, ms", "copies_ms"),
                              ("exchange, ms", "exchange_ms"), ("throughput of copies", "of_copies")])],
    "scaling": [("rows", [("ranks", "ranks"), ("n", "n"), ("refined", "refine"), ("hexahedra", "hexahedra"), ("unknowns", "unknowns"),
                          ("Krylov iterations", "iterations"), ("set-up s", "setup_s"), ("ms per iteration", "iteration_ms"),
                          ("rank µs per unknown", "us_per_unknown"), ("messages", "messages"), ("kB", "kb"), ("global sums", "reductions"),
                          ("peak MB of a rank", "peak_mb"), ("failure", "reason")])],
    "mesh_convergence": [
        ("rows", [("n", "n"), ("refined", "refine"), ("hexahedra", "hexahedra"), ("unknowns", "unknowns"), ("processor s", "cpu_s"),
                  ("peak MB", "peak_mb"), ("Newton iterations", "newton_iterations"), ("Krylov iterations", "krylov_iterations"),
                  ("failure", "reason")]),
        ("probes", [("figure", "probe"), ("unit", "unit"), ("coarse", "level_0"), ("middle", "level_1"), ("fine", "level_2"),
                    ("extrapolated", "extrapolated"), ("observed order", "order"), ("error of the fine one, %", "error_percent")])],
    "contact_search": [("rows", [("slave nodes", "nodes"), ("triangles", "triangles"), ("candidates per node", "candidates_per_node"),
                                 ("global search, ns per node", "global_ns_per_node"), ("slave normals", "normals_ns_per_node"),
                                 ("local search", "local_ns_per_node"), ("tracked", "tracked_ns_per_node")])],
}
SUMMARY = [("n", "n"), ("unknowns", "unknowns"), ("solver", "method"), ("linear solves", "linear_solves"),
           ("one linear solve, s", "linear_s"), ("whole run, s", "total_s"), ("peak memory, MB", "peak_mb")]

OPERATION = [("", "method"), ("hexahedra", "hexahedra"), ("unknowns", "unknowns"), ("processor time, min", "cpu_min"),
             ("peak memory, MB", "peak_mb"), ("Newton iterations", "newton_iterations"), ("Krylov iterations", "krylov_iterations"),
             ("ends", "reason")]
# What the paper says of its own run: 20 hours on one processor of 2 GHz.
PAPER = {"method": "paper, one 2 GHz processor of the 2000s", "hexahedra": 7421, "cpu_min": 1200., "peak_mb": 600}


# Of one size: the iterative variants beside the direct ones that are quickest, as solver and as preconditioner, and smallest.
BEST = [("n", "n"), ("refined", "refined"), ("unknowns", "unknowns"), ("solver", "method"), ("linear solves", "linear_solves"),
        ("Krylov iterations", "krylov"), ("linear solve, s", "wall_s"), ("whole run, s of the processor", "total_s"), ("peak MB", "peak_mb"),
        ("residual", "reduction"), ("best of the direct", "best")]


def value(row, key):
    for part in key.split("."):
        row = row.get(part) if isinstance(row, dict) else None
    if row is None or row == "":
        return ""
    if isinstance(row, float):
        return answers.number(row)
    return f"{row:,}" if isinstance(row, int) and not isinstance(row, bool) else str(row)


def table(rows, columns):
    columns = [c for c in columns if any(value(r, c[1]) for r in rows)]
    lines = [[heading for heading, _ in columns], ["---" if isinstance(rows[0].get(k), str) else "---:" for _, k in columns]]
    lines += [[value(r, key) for _, key in columns] for r in rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def beside_paper(report):
    return [PAPER] + [{**row, "wall_min": row["wall_s"] / 60} for row in report["rows"]]


def from_rest():
    """Runs of the working mesh and finer ones; of one that does not fit, what its memory would be."""
    names = [n for n in ("direct_vs_iterative", "direct_vs_iterative_56") if (HERE / "results" / f"{n}.json").exists()]
    rows = [row for name in names for row in result(name)["rows"] if row["n"] >= 14]
    return [row if not row.get("too_large") else
            {**{k: row[k] for k in ("n", "unknowns", "method")}, "peak_mb": f"{row['estimated_mb']:,.0f} (estimate: refused)"} for row in rows]


def beside_best(report):
    done = [row for row in report["rows"] if not row.get("reason")]
    direct = [row for row in done if row["method"].startswith("direct")]
    best = {}
    for what, rows, key in (("time", [r for r in direct if "gmres" not in r["method"]], "wall_s"),
                            ("time, as preconditioner", [r for r in direct if "gmres" in r["method"]], "wall_s"), ("memory", direct, "peak_mb")):
        if rows:
            best.setdefault(min(rows, key=lambda row: row[key])["method"], []).append(what)
    shown = [{**row, "best": "; ".join(best.get(row["method"], []))} for row in done if row not in direct or row["method"] in best]
    return [{**row, "refined": row["refined"] or None} for row in shown]


def best_table():
    rows = [row for name, report in series.records(HERE / "results").items() if name.startswith("direct_solvers") for row in beside_best(report)]
    return table(rows, BEST) if rows else ""


def rows_of(report, where):
    return beside_paper(report) if (report["program"], where) == ("operation", "rows") else report[where]


def tables(path):
    report = json.loads(path.read_text())
    question, answer = answers.answer(path.stem, report)
    parts = [f"### {path.stem}"] + ([f"**{question}** {answer}"] if question else [])
    for where, columns in TABLES[report["program"]]:
        if report.get(where):
            parts.append(table(rows_of(report, where), columns))
    machine = "".join(f"; {k.replace('_', ' ')} {v:.3g}" for k, v in report.get("machine", {}).items())
    parts.append(f"{report['processor']}, {report['ranks']} rank, {report['threads']} thread; commit {report['commit']}; "
                 f"{report['compiler']}, {report['flags'].strip()}; load {report['load_at_start']:.2g} at the start{machine}. "
                 f"{report['notes'][0].upper() + report['notes'][1:]}.")
    return "\n\n".join(parts)


def recorded():
    return [path for path in sorted((HERE / "results").glob("*.json")) if path.name != series.NAME]


def answers_table():
    rows = []
    for name, report in series.records(HERE / "results").items():
        question, answer = answers.answer(name, report)
        rows.append({"question": question, "answer": answer, "record": f"[`{name}`](#{name})"})
    return table(rows, [("question", "question"), ("answer", "answer"), ("record", "record")])


def all_tables(files):
    return "\n\n".join(tables(f) for f in files)


def result(name):
    return json.loads((HERE / "results" / f"{name}.json").read_text())


def replaced(text, name, block):
    """The text with what stands between the markers of a name replaced."""
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    return text.split(begin)[0] + begin + "\n\n" + block + "\n\n" + end + text.split(end)[1]


def percent(error):
    return "" if error == "" else f"{100 * float(error):.2g}"


def trade_rows():
    path = HERE.parent / "docs" / "trade.csv"
    if not path.exists():
        return []
    with open(path) as file:
        return list(csv.DictReader(file))


def trade_runs(rows):
    out = []
    for r in rows:
        of_mesh = r["mesh"] == rows[0]["mesh"]
        out.append({"parameter": r["parameter"], "value": r["value"] or " ", "seconds": f"{float(r['seconds [s]']):.1f}",
                    "newton": r["newton_iterations"], "krylov": r["krylov_iterations"], "mb": f"{float(r['memory [MB]']):.0f}",
                    "error": percent(r["error"]) if r["converged"] == "true" else r["reason"], "error_in": r["error_in"],
                    "front": {"front": "yes"}.get(r["front"], "") if of_mesh else "", "whole": percent(r["extrapolated_error"]),
                    "whole_front": {"front": "yes"}.get(r["extrapolated_front"], "")})
    return out


# Every figure as the tight reference and the extrapolation have it, and the errors of each accuracy on the scene's mesh.
def trade_figures(rows):
    reference = rows[0]
    accuracies = {r["value"].removeprefix("accuracy "): r for r in rows if r["parameter"] in ("accuracy", "scene")}
    names = [c.removesuffix(" extrapolated error") for c in reference if c.endswith(" extrapolated error")]
    out = []
    for name in names:
        column = next(c for c in reference if c.split(" [")[0] == name)
        row = {"figure": column, "reference": f"{float(reference[column]):.6g}", "mesh": percent(reference[name + " extrapolated error"])}
        out.append(row | {a: percent(accuracies[a][name + " error"]) for a in accuracies})
    return out, list(accuracies)


def trade_tables():
    rows = trade_rows()
    if not rows:
        return ""
    figures, accuracies = trade_figures(rows)
    return "\n\n".join([table(trade_runs(rows), TRADE),
                        table(figures, [("figure", "figure"), ("tight reference", "reference")] + [(f"{a}, %", a) for a in accuracies] +
                              [("mesh, %", "mesh")])])


CLINICAL = [("run", "run"), ("n", "n"), ("after", "step"), ("IOP, mmHg", "IOP"), ("peak", "IOP_peak"), ("drained, µL", "drained"),
            ("axis, mm", "axial_change"), ("refraction, D", "refraction"), ("cornea, D", "corneal_power"), ("astigmatism, D", "corneal_astigmatism"),
            ("buckle over the tear's front, back, mm", "height"), ("rim sealed", "tear_sealed"), ("reattached", "retina_reattached"),
            ("retina on choroid, mmHg", "choroid_contact_pressure"), ("band, N", "band_tension"), ("at sutures, kPa", "suture_mises_mean"),
            ("Newton", "newton"), ("Krylov", "krylov")]
DECIMALS = {"IOP": "{:.1f}", "IOP_peak": "{:.1f}", "drained": "{:.0f}", "axial_change": "{:+.2f}", "refraction": "{:+.2f}", "corneal_power": "{:+.2f}",
            "corneal_astigmatism": "{:.2f}", "tear_sealed": "{:.0%}", "retina_reattached": "{:.0%}", "choroid_contact_pressure": "{:.2f}",
            "band_tension": "{:.2f}", "suture_mises_mean": "{:.0f}"}


# The operation after every step, by benchmarks/drainage.py.
def clinical_table():
    path = HERE.parent / "docs" / "operation.csv"
    if not path.exists():
        return ""
    with open(path) as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        front, back = row["buckle_height_front"], row["buckle_height_back"]
        row["height"] = f"{float(front):.2f}, {float(back):.2f}" if front else ""
        row |= {key: form.format(float(row[key])) if row[key] else "" for key, form in DECIMALS.items()}
    return table(rows, CLINICAL)


def scaling_rows():
    files = sorted((HERE / "results").glob("scaling_*.json"))
    return [row for f in files for row in json.loads(f.read_text())["rows"]]


def large_facts():
    s = result("large/summary")
    peak = s["memory_mb"]["process_peak"]["all_ranks"]
    return (f"{s['hexahedra']:,} hexahedra, {s['unknowns']['total']:,} unknowns on {s['ranks']} ranks: {s['seconds']['total'] / 60:.0f} minutes, "
            f"{peak / 1e3:.1f} GB at the peak (all ranks), {1e6 * peak / s['unknowns']['total']:.0f} bytes per unknown.")


def large_tables():
    s = result("large/summary")
    memory = s["memory_mb"]
    steps = [{**step, "minutes": step["seconds"] / 60} for step in s["steps"]]
    parts = [{"part": part, "mb": round(mb["all_ranks"])} for part, mb in sorted(memory["parts"].items()) if mb["all_ranks"] >= 1]
    seconds = [{"part": part, "minutes": t / 60} for part, t in sorted(s["seconds"].items(), key=lambda i: -i[1]) if t >= 1]
    probes = [{"figure": name, "value": f"{v:.5g}", "unit": s["units"].get(name, "")} for name, v in s["probes"].items() if v is not None]
    return "\n\n".join([
        large_facts(),
        table(steps, [("step", "name"), ("increments", "increments"), ("Newton", "newton_iterations"), ("Krylov", "krylov_iterations"),
                      ("cuts", "cuts"), ("minutes", "minutes")]),
        table(seconds, [("time", "part"), ("minutes", "minutes")]),
        table(parts, [("memory, peak of the part", "part"), ("MB, all ranks", "mb")]),
        table(probes, [("figure", "figure"), ("value", "value"), ("unit", "unit")])])


# The same run on coarser meshes beside the large one.
def growth_table():
    rows = []
    for name in ("refine_1", "refine_2", "summary"):
        s = result(f"large/{name}")
        unknowns, peak = s["unknowns"]["total"], s["memory_mb"]["process_peak"]["all_ranks"]
        rows.append({"hexahedra": s["hexahedra"], "unknowns": unknowns, "ranks": s["ranks"], "seconds": s["seconds"]["total"],
                     "us": 1e6 * s["ranks"] * s["seconds"]["total"] / unknowns, "peak": peak, "bytes": 1e6 * peak / unknowns,
                     "expected": s["memory_mb"].get("forecast", {}).get("together", ""), "newton": s["totals"]["newton_iterations"],
                     "krylov": s["totals"]["krylov_iterations"], "iop": f"{s['probes']['IOP']:.4f}", "axial": f"{s['probes']['axial_change']:.4f}"})
    return table(rows, [("hexahedra", "hexahedra"), ("unknowns", "unknowns"), ("ranks", "ranks"), ("s", "seconds"), ("rank µs per unknown", "us"),
                        ("peak MB", "peak"), ("forecast MB", "expected"), ("bytes per unknown", "bytes"), ("Newton", "newton"),
                        ("Krylov", "krylov"), ("IOP, mmHg", "iop"), ("axial change, mm", "axial")])


LATENCY, BANDWIDTH = 2e-6, 1e9  # s a message and a doubling of a sum's ranks; bytes per second of a rank


# Rows of the model of docs/scaling.md for 10^9 unknowns, from the largest measured system on two ranks and the memory of the large run.
def model_rows():
    measured = [r for r in scaling_rows() if r["ranks"] == 2]
    if not measured:
        return []
    of = max(measured, key=lambda r: r["unknowns"])
    large = result("large/summary")
    per_rank, hexes = of["unknowns"] / 2, of["hexahedra"] / 2
    ghosts_of = lambda cells: 3 * cells ** (2 / 3)  # half the surface of a cube: the other half belongs to its neighbours
    rows = []
    for ranks in (128, 256, 512):
        share = 1e9 / ranks
        cells = share * hexes / per_rank
        compute = of["us_per_unknown"] * 1e-6 * share
        sent = of["kb"] * 1e3 * ghosts_of(cells) / of["ghosts"]
        neighbours = 12  # of a part of a shell a few parts thick
        network = sent / BANDWIDTH + neighbours * of["messages"] * LATENCY
        sums = of["reductions"] * LATENCY * ranks.bit_length()
        rows.append({"ranks": ranks, "share": round(share), "gb": large["memory_mb"]["process_peak"]["all_ranks"] / 1e3 / large["unknowns"]["total"] * share, "compute": compute,
                     "network": network, "sums": sums, "total": compute + network + sums})
    return rows


MODEL = [("ranks", "ranks"), ("unknowns of a rank", "share"), ("GB of a rank", "gb"), ("an iteration: computing, s", "compute"),
         ("messages, s", "network"), ("global sums, s", "sums"), ("together, s", "total")]


def mesh_table():
    path = HERE / "results" / "mesh_convergence.json"
    if not path.exists():
        return ""
    report = json.loads(path.read_text())
    return "\n\n".join(table(report[where], columns) for where, columns in TABLES["mesh_convergence"])


def scaling_blocks():
    rows = scaling_rows()
    return {"scaling": table(rows, TABLES["scaling"][0][1]) if rows else "", "large": large_tables(), "growth": growth_table(),
            "model": table(model_rows(), MODEL) if rows else ""}


def pages():
    """Path, text as it is and text as it should be of every page with tables."""
    blocks = {"README.md": {"tables": table(from_rest(), SUMMARY),
                            "operation": table(beside_paper(result("operation")), OPERATION), "large": large_facts()},
              "docs/benchmarks.md": {"answers": answers_table(), "best": best_table(), "tables": all_tables(recorded())},
              "docs/trade.md": {"trade": trade_tables()},
              "docs/operation.md": {"clinical": clinical_table()},
              "docs/scaling.md": scaling_blocks(),
              "docs/verification.md": {"mesh": mesh_table()}}
    for name, of_page in blocks.items():
        path = HERE.parent / name
        right = text = path.read_text()
        for marker, block in of_page.items():
            right = replaced(right, marker, block)
        yield path, text, right


def main(arguments):
    if arguments == ["--write"]:
        for path, _, right in pages():
            path.write_text(right)
    elif arguments == ["--check"]:
        stale = [path.name for path, text, right in pages() if text != right]
        mixed = series.faults(HERE / "results")
        if mixed:
            sys.exit("\n".join(mixed) + "\nRecord the whole series with benchmarks/all --full.")
        if stale:
            sys.exit(f"{', '.join(stale)}: not what benchmarks/results says; run benchmarks/tables.py --write")
    else:
        print(all_tables([pathlib.Path(a) for a in arguments] or recorded()))


main(sys.argv[1:])
