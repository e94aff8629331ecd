# Copies a scene and puts the depth map and its noise in the place of its own. The scene of a refused clip is an empty
# folder.
import json
import shutil
import sys
from pathlib import Path

folder = Path(snakemake.output.scene)
if not Path(snakemake.input.depth).stat().st_size:
    folder.mkdir(parents=True, exist_ok=True)
    sys.exit(0)
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
