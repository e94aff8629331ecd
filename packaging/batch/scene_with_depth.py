# Copies a scene and puts the depth map and its noise in the place of its own.
import json
import shutil
from pathlib import Path

folder = Path(snakemake.output.scene)
shutil.copytree(snakemake.input.first, folder, dirs_exist_ok=True)
file = folder / "scene.json"
scene = json.loads(file.read_text())
backdrop = scene["backdrop"]
for key, default, source in (
    ("depth", "depth.tiff", snakemake.input.depth),
    ("depth_sigma", "depth-sigma.tiff", snakemake.input.sigma),
):
    backdrop.setdefault(key, default)
    shutil.copy(source, folder / backdrop[key])
file.write_text(json.dumps(scene, indent=2) + "\n")
