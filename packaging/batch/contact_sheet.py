# One HTML page with a row per clip: pictures, placed and rejected frames, expected error, depth noise and verdict.
import html
import json
from collections import Counter
from pathlib import Path

out = Path(snakemake.params.out)


def number(value, factor=1.0, digits=1):
    return "–" if value is None else f"{factor * value:.{digits}f}"


def row(name):
    report = json.loads((out / name / "panorama.json").read_text())
    check = json.loads((out / name / "check.json").read_text())
    frames = report["frames"]
    reasons = Counter(frame["reason"] for frame in frames if frame["status"] == "rejected")
    placed = sum(frame["status"] == "placed" for frame in frames)
    noise = check.get("relief", {}).get("median_sigma")
    remarks = [f"{count} × {reason}" for reason, count in reasons.items()]
    remarks += (out / name / "lens.txt").read_text().splitlines()
    remarks += check.get("errors", []) + check.get("warnings", [])
    cells = [
        html.escape(name),
        f'<a href="{name}/panorama.png"><img src="{name}/panorama.png" alt="panorama"></a>',
        f'<a href="{name}/view.png"><img src="{name}/view.png" alt="view through the scope"></a>',
        f"{placed} / {len(frames) - placed}",
        f'{number(report["mean_error_px"])} / {number(report["max_error_px"])}',
        number(noise, 1e3, 2),
        html.escape(check["status"]),
        "<br>".join(html.escape(str(remark)) for remark in remarks),
    ]
    return "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"


head = [
    "clip", "panorama", "view", "frames placed / rejected", "expected error, mean / largest, px",
    "depth noise, mm", "check", "remarks",
]
style = (
    "body{font:15px sans-serif;margin:1rem}table{border-collapse:collapse}"
    "th,td{text-align:left;vertical-align:top;padding:.4rem .8rem;border-bottom:1px solid #ccc}"
    "img{height:140px;max-width:280px;object-fit:contain;background:#000}"
)
page = f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Scenes</title><style>{style}</style></head><body>
<h1>{len(snakemake.params.names)} clips</h1>
<table><tr>{"".join(f"<th>{word}</th>" for word in head)}</tr>
{chr(10).join(row(name) for name in snakemake.params.names)}
</table></body></html>
"""
Path(snakemake.output[0]).write_text(page)
