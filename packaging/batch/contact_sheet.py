# One HTML page with a row per clip: pictures, frames, expected error, depth noise and verdict.
import html
import json
from collections import Counter
from pathlib import Path
from urllib.parse import quote

out = Path(snakemake.params.out)


def number(value, factor=1.0, digits=1):
    return "–" if value is None else f"{factor * value:.{digits}f}"


def read(file):
    """JSON of a file; an empty one, of a refused clip, is {}."""
    text = file.read_text()
    return json.loads(text) if text else {}


def picture(name, shown, opened, words):
    """A small picture that opens the large one; nothing for a refused clip."""
    if not (out / name / shown).stat().st_size:
        return "–"
    # Names of folders may hold any letter.
    return (f'<a href="{quote(name)}/{opened}"><img src="{quote(name)}/{shown}" '
            f'alt="{words} of {html.escape(name)}"></a>')


def row(name):
    report, check = read(out / name / "panorama.json"), read(out / name / "check.json")
    frames = report.get("frames", [])
    reasons = Counter(frame["reason"] for frame in frames if frame["status"] == "rejected")
    placed = sum(frame["status"] == "placed" for frame in frames)
    skipped = sum(frame["reason"].startswith("skipped: ") for frame in frames)
    remarks = []
    for step in ("panorama", "depth", "check", "view"):
        remarks += [f"{step}: {line}" for line in (out / name / f"{step}.txt").read_text().splitlines()]
    is_refused = bool(remarks)
    remarks += [f"{count} × {reason}" for reason, count in reasons.items()]
    remarks += (out / name / "lens.txt").read_text().splitlines()
    remarks += check.get("errors", []) + check.get("warnings", [])
    verdict = "refused" if is_refused else check.get("status", "not checked")
    cells = [
        html.escape(name),
        picture(name, "panorama-small.png", "panorama.png", "panorama"),
        picture(name, "view.png", "view.png", "view"),
        f"{placed} / {len(frames) - placed - skipped} / {skipped}" if frames else "–",
        f'{number(report.get("mean_error_px"))} / {number(report.get("max_error_px"))}',
        number(check.get("relief", {}).get("median_sigma"), 1e3, 2),
        html.escape(verdict),
        "<br>".join(html.escape(str(remark)) for remark in remarks),
    ]
    mark = ' class="refused"' if is_refused else ""
    return f"<tr{mark}>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"


head = [
    "clip", "panorama", "view", "frames placed / rejected / skipped", "expected error, mean / largest, px",
    "depth noise, mm", "check", "remarks",
]
style = (
    "body{font:15px sans-serif;margin:1rem}table{border-collapse:collapse}"
    "th,td{text-align:left;vertical-align:top;padding:.4rem .8rem;border-bottom:1px solid #ccc}"
    "img{height:140px;max-width:280px;object-fit:contain;background:#000}"
    ".refused{background:#fbeaea}td:last-child{overflow-wrap:anywhere;min-width:14rem}"
    "@page{size:A4 landscape;margin:1cm}"
    "@media print{body{font-size:10px;margin:0}th,td{padding:.3rem}img{height:90px;max-width:130px}}"
)
page = f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Scenes</title><style>{style}</style></head><body>
<h1>{len(snakemake.params.names)} clips</h1>
<table><tr>{"".join(f"<th>{word}</th>" for word in head)}</tr>
{chr(10).join(row(name) for name in snakemake.params.names)}
</table></body></html>
"""
Path(snakemake.output[0]).write_text(page)
