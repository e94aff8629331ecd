# Tables of a sweep: for each benchmark, clip and way, the median over the seeds and the range. Every row of every run
# is kept as CSV.
import csv
import html
import json
from collections import defaultdict
from pathlib import Path
from statistics import median

COLUMNS = {  # of each benchmark: the way, then numbers with the words and the factor that the table shows
    "panorama": ("chain", [("cpu_ms_per_frame", "CPU ms per frame", 1), ("mean_px", "mean error, px", 1),
                           ("max_px", "largest error, px", 1), ("right", "frames right", 1),
                           ("wrong_as_good", "wrong, as good", 1), ("covered", "within expected error, %", 100)]),
    "relief": ("way", [("cpu_ms_per_frame", "CPU ms per frame", 1), ("rmse_mm", "rms error, mm", 1),
                       ("median_mm", "median error, mm", 1), ("within_1mm", "within 1 mm, %", 100),
                       ("spearman", "Spearman", 1), ("force_error", "force error, N rms", 1),
                       ("coverage", "covered, %", 100)]),
}


def cell(numbers):
    if not numbers:
        return "–"
    low, middle, high = min(numbers), median(numbers), max(numbers)
    return f"{middle:.3g}" if low == high else f"{middle:.3g} <small>({low:.3g} to {high:.3g})</small>"


def table(job, runs):
    way, columns = COLUMNS[job]
    groups = defaultdict(list)
    for run in runs:
        for row in run["rows"]:
            if row["outcome"] == "done":
                groups[row["clip"], row[way]].append(row)
    head = "".join(f"<th>{word}</th>" for word in ["clip", way, "runs", *(words for _, words, _ in columns)])
    lines = []
    for (clip, name), rows in groups.items():
        cells = [html.escape(clip), html.escape(name), str(len(rows))]
        cells += [cell([factor * row[key] for row in rows if row[key] is not None]) for key, _, factor in columns]
        lines.append("<tr>" + "".join(f"<td>{text}</td>" for text in cells) + "</tr>")
    return f"<h2>{job}</h2><table><tr>{head}</tr>" + "\n".join(lines) + "</table>"


runs = defaultdict(list)
with open(snakemake.output.rows, "w", newline="") as file:
    writer = csv.writer(file)
    writer.writerow(["job", "seed", "machine", "clip", "way", "number", "value"])
    for name in snakemake.input:
        job, seed = Path(name).stem.split("-")
        run = json.loads(Path(name).read_text())
        runs[job].append(run)
        for row in run["rows"]:
            for key, value in row.items():
                if isinstance(value, (int, float)) and not isinstance(value, bool):
                    writer.writerow([job, seed, run["machine"], row["clip"], row[COLUMNS[job][0]], key, value])

machines = sorted({run["machine"] for of_job in runs.values() for run in of_job})
style = (
    "@page{size:A4 landscape;margin:10mm}@media print{body{font-size:10px}}"
    "body{font:15px sans-serif;margin:1rem}table{border-collapse:collapse}small{color:#555}"
    "th,td{text-align:left;padding:.25rem .8rem;border-bottom:1px solid #ccc}"
)
page = f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Speed against error</title><style>{style}</style></head><body>
<h1>Speed against error</h1>
<p>Median over the seeds, and the range. Errors are against the known truth of the drawn clips. {html.escape("; ".join(machines))}.</p>
{"".join(table(job, runs[job]) for job in snakemake.params.jobs)}
</body></html>
"""
Path(snakemake.output.page).write_text(page)
