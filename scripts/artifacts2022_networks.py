"""Train the network of the artifact detection paper on a clean recording (skurowski2022, 3.3.3).

Reads: PREPARED, a clean recording. Writes: NETWORKS, the networks of its markers.
"""

from markermend.evaluation.artifacts2022 import command
from markermend.evaluation.artifacts2022.network_file import write_networks
from markermend.evaluation.artifacts2022.published_detectors import learn, options_of


def main(argv: list[str] | None = None) -> None:
    job = command.begin(command.parser("artifacts2022_networks.py", __doc__, writes="networks"), argv)
    write_networks(job.flags.networks, learn(job.clean, options_of(job.options)))


if __name__ == "__main__":
    main()
