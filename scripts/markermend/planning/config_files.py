"""The files that are generated from the declared options: config.yaml, its schema, and the tables of config/README.md.

Writes: config/config.yaml, workflow/schemas/config.schema.yaml, and what stands between two markers in config/README.md.
`make config` runs it.
"""

from __future__ import annotations

from pathlib import Path

from markermend.planning import config_yaml, option_schema, option_tables
from markermend.storage import atomic


def generate(project: Path) -> dict[Path, str]:
    """Generate all the files.

    Parameters
    ----------
    project : Path
        The folder of the project.

    Returns
    -------
    dict
        The content of each file, by its path.
    """
    page = project / "config/README.md"
    return {
        project / "config/config.yaml": config_yaml.config_yaml(),
        project / "workflow/schemas/config.schema.yaml": option_schema.schema_yaml(),
        page: option_tables.readme(page.read_text(encoding="utf-8")),
    }


if __name__ == "__main__":
    for path, content in generate(Path(__file__).parents[3]).items():
        atomic.write_text(path, content)
