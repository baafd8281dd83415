"""Where the files of the project lie.

Reads: the repository that a module of another workflow names (`github(...)`), where that is what runs.
Writes: nothing in a checkout; else the files of that repository, beside those that Snakemake keeps of it in its cache.
"""

import os
from pathlib import Path

from snakemake.sourcecache import LocalGitFile, LocalSourceFile

NEEDED = ("scripts", "workflow", "config", "envs")


def checkout(rules):
    """The folder of the project, given that of its rules. Snakemake fetches the files of a remote module one by one, and the commands of stages
    need all of them: they are written where it put this file, each as a whole."""
    if isinstance(rules, LocalSourceFile):
        return Path(rules.get_path_or_uri(secret_free=True)).parents[1]
    import git

    folder = Path(workflow.source_path("project.smk")).parents[2]
    repository = git.Repo(rules.repo_path) if isinstance(rules, LocalGitFile) else rules.hosted_repo.repo
    for file in repository.commit(rules.ref).tree.traverse():
        path = folder / file.path
        if file.type == "blob" and file.path.startswith(tuple(f"{name}/" for name in NEEDED)) and not path.exists():
            path.parent.mkdir(parents=True, exist_ok=True)
            partial = path.with_name(f".{path.name}.{os.getpid()}")
            partial.write_bytes(file.data_stream.read())
            partial.replace(path)
    return folder


PROJECT = checkout(workflow.current_basedir)
