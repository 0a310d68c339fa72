# Contacts, the certificate and the statistics, of the hulls and of the outlines alike.


# Pairs of particles that touch, with position and normal.
rule contacts:
    input:
        packing=lambda w: f"results/{w.scene}/{w.seed}/{KINDS[w.kind]}.nc",
    output:
        contacts="results/{scene}/{seed}/contacts{kind}.nc",
    params:
        scene=lambda wildcards: scene_file(wildcards.scene),
        sources=stages.sources_digest("contacts"),
    message:
        "{wildcards.scene}: contacts{wildcards.kind} of seed {wildcards.seed}"
    script:
        "../scripts/contacts.py"


# All seeds of a scene; fails where the certificate of one does not hold.
rule statistics:
    input:
        zone_files,
        database="results/{scene}/shapes.nc",
        packings=lambda w: [
            f"results/{w.scene}/{seed}/{KINDS[w.kind]}.nc"
            for seed in SCENES[w.scene].seeds
        ],
    output:
        statistics="results/{scene}/statistics{kind}.nc",
    params:
        scene=lambda wildcards: scene_file(wildcards.scene),
        seeds=lambda wildcards: SCENES[wildcards.scene].seeds,
        sources=stages.sources_digest("statistics"),
    message:
        "{wildcards.scene}: certificate and statistics{wildcards.kind}"
    script:
        "../scripts/statistics.py"
