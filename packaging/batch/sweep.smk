# Speed against error over many seeds: each benchmark once per seed, and one page of tables over all of them.
#   snakemake -s packaging/batch/sweep.smk --cores 2 --config seeds=20 out=SWEEP
# Each benchmark draws its easy, medium and hard clip and runs every estimator on them. Times are processor times, so
# that runs beside one another may be compared; on a cluster, use nodes of one kind.
import sys
from pathlib import Path

configfile: str(Path(workflow.basedir) / "sweep.yaml")

OUT = Path(config["out"])
PROGRAM = config["program"]
if not str(config["seeds"]).isdecimal() or int(config["seeds"]) == 0:
    sys.exit(f'{config["seeds"]}: give the number of seeds, such as seeds=20')
SEEDS = range(1, int(config["seeds"]) + 1)
JOBS = config["jobs"].split()

wildcard_constraints:
    job="[a-z]+",
    seed="[0-9]+",

localrules: all, tables


rule all:
    input:
        OUT / "index.html",


rule bench:
    output:
        OUT / "{job}-{seed}.json",
    params:
        options=lambda wildcards: config.get(wildcards.job, ""),
    threads: 1
    resources:
        mem_mb=3000,
    shell:
        "{PROGRAM} bench {wildcards.job} --seed {wildcards.seed} {params.options} --json {output:q} > /dev/null"


rule tables:
    input:
        expand(OUT / "{job}-{seed}.json", job=JOBS, seed=SEEDS),
    output:
        page=OUT / "index.html",
        rows=OUT / "rows.csv",
    params:
        jobs=JOBS,
    script:
        "sweep_tables.py"
