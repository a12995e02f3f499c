"""The question of every benchmark, and its answer in a sentence that is made of its record."""


def number(v):
    return f"{v:,.0f}" if abs(v) >= 1000 else f"{v:.3g}"


def row_of(report, **wanted):
    return next((r for r in report["rows"] if all(r.get(k) == v for k, v in wanted.items())), None)


def largest_ratio(report):
    return max((r for r in report.get("ratios", []) if r.get("linear_s")), key=lambda r: r["unknowns"], default=None)


def answer_apply(report):
    ns = {r["variant"]: r["ns_per_hex"] for r in report["rows"]}
    on_the_fly, stored, smoother = ns["recompute"], ns["3x3 BCSR"], ns["mean, single"]
    return (f"{number(on_the_fly / stored)} of the time of a product with its stored 3×3 blocks ({number(on_the_fly)} and {number(stored)} ns per "
            f"hexahedron), and {number(smoother / stored)} of it averaged and in single precision, as smoothers apply it.")


def answer_apply_ranks(report):
    worst = min(r["of_copies"] for r in report["rows"])
    return f"{report['ranks']} ranks apply one tangent with {worst:.0%} of the throughput of as many independent copies."


def answer_contact_search(report):
    first, last = report["rows"][0], report["rows"][-1]
    return (f"From {first['nodes']:,} to {last['nodes']:,} slave nodes the global search takes {number(first['global_ns_per_node'])} to "
            f"{number(last['global_ns_per_node'])} ns per node, and {number(last['tracked_ns_per_node'])} ns where the triangle before is known.")


def answer_direct_vs_iterative(report):
    ratio = largest_ratio(report)
    if not ratio:
        alone = next((r for r in report["rows"] if r["method"] == "iterative" and r.get("linear_s")), None)
        return (f"{number(alone['linear_s'])} s a linear solve, {number(alone['total_s'])} s and {number(alone['peak_mb'])} MB a run at "
                f"{alone['unknowns']:,} unknowns; the direct solver is refused for want of memory." if alone else "No run ended.")
    return (f"At {ratio['unknowns']:,} unknowns a linear solve of the iterative solver takes {number(ratio['linear_s'])} of the direct solver's time, "
            f"the run {number(ratio['total_s'])} of its time and {number(ratio['peak_mb'])} of its memory.")


def answer_direct_solvers(report):
    done = [r for r in report["rows"] if not r.get("reason")]
    direct = [r for r in done if r["method"].startswith("direct") and "gmres" not in r["method"]]
    own = row_of({"rows": done}, method="iterative")
    if not direct or not own:
        return "No pair of runs ended."
    best = min(direct, key=lambda r: r["wall_s"])
    small = min(direct, key=lambda r: r["peak_mb"])
    return (f"The quickest direct one is `{best['method']}` ({number(best['wall_s'])} s a linear solve), the smallest `{small['method']}` "
            f"({number(small['peak_mb'])} MB); the iterative solver takes {number(own['wall_s'] / best['wall_s'])} of the time and "
            f"{number(own['peak_mb'] / small['peak_mb'])} of the memory.")


def answer_precond(report):
    rows = [r for r in report["rows"] if not r.get("reason") and r["displacement"] not in ("direct", "exact")]
    seconds = lambda r: r["setup_s"] + r["solve_s"]
    best = min(rows, key=seconds)
    text = ", ".join(f"`{r['displacement']}` {r['iterations']} ({number(seconds(r))} s)" for r in rows)
    return f"`{best['displacement']}` is the quickest; iterations and seconds with set-up: {text}."


def answer_formulations(report):
    sizes = sorted({r["n"] for r in report["rows"]})
    kept = row_of(report, n=sizes[-1], method="direct", formulation="bordered")
    gone = row_of(report, n=sizes[-1], method="direct", formulation="eliminated")
    return (f"It leaves {number(kept['factor_entries'] / 1e6)} million entries in the factors where eliminating it leaves "
            f"{number(gone['factor_entries'] / 1e6)} million, at {number(gone['gflop'] / kept['gflop'])} times the operations.")


def answer_operation(report):
    rows = {r["method"]: r for r in report["rows"]}
    own, direct = rows["iterative"], rows["direct"]
    worst = max(p["relative"] for p in report["probes"])
    return (f"{number(own['cpu_min'])} minutes and {number(own['peak_mb'])} MB against {number(direct['cpu_min'])} minutes and "
            f"{number(direct['peak_mb'])} MB; every figure agrees to {worst:.1g}.")


def answer_features(report):
    rows = report["rows"]
    return "; ".join(f"{r['scene']}: {number(r['cpu_min'])} minutes, {number(r['peak_mb'])} MB" for r in rows) + "."


def answer_scaling(report):
    last = report["rows"][-1]
    ranks = f"{last['ranks']} rank{'s' if last['ranks'] > 1 else ''}"
    return (f"{number(last['iteration_ms'])} ms an iteration at {last['unknowns']:,} unknowns on {ranks}: "
            f"{number(last['us_per_unknown'])} µs of a rank per unknown.")


def answer_mesh_convergence(report):
    worst = max(report["probes"], key=lambda p: abs(p["error_percent"]))
    return f"The figure that is farthest from its extrapolation on the finest mesh is {worst['probe']}, by {number(worst['error_percent'])} %."


# record's name begins with -> question, answer
ANSWERS = [
    ("apply_ranks", "What does sharing a tangent between ranks cost?", answer_apply_ranks),
    ("apply", "Is the tangent cheaper applied on the fly than stored?", answer_apply),
    ("contact_search", "Does finding contact pairs stay linear?", answer_contact_search),
    ("direct_solvers", "Which direct solver is the best, and what is the iterative one against it?", answer_direct_solvers),
    ("direct_vs_iterative_refined", "What are time and memory against a direct solver, on meshes with a hierarchy?", answer_direct_vs_iterative),
    ("direct_vs_iterative", "What are time and memory against a direct solver, on meshes without a hierarchy?", answer_direct_vs_iterative),
    ("precond", "Which preconditioner of the displacement block is the best?", answer_precond),
    ("formulations", "What does the liquid's pressure as an unknown save?", answer_formulations),
    ("operation", "What does the whole operation take?", answer_operation),
    ("features", "What do the parts of a scene cost?", answer_features),
    ("scaling", "What does a Krylov iteration take?", answer_scaling),
    ("mesh_convergence", "How far are the figures of the half eye from their limits?", answer_mesh_convergence),
]


def answer(name, report):
    """Question and answer of a record; of one that is not known, none."""
    for begins, question, sentence in ANSWERS:
        if name.startswith(begins):
            return question, sentence(report)
    return "", ""
