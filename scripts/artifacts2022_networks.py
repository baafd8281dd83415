"""Train the network of the artifact detection paper on a clean recording (skurowski2022, 3.3.3).

Reads: PREPARED, a clean recording. Writes: NETWORKS, the networks of its markers; none where the options say that contaminated recordings are
learned.
"""

from markermend.evaluation.artifacts2022 import command
from markermend.evaluation.artifacts2022.network_file import write_networks
from markermend.evaluation.artifacts2022.published_detectors import learn, network_of, options_of
from markermend.prediction.lagged_regression.predictor import TrainedRegressions


def main(argv: list[str] | None = None) -> None:
    job = command.begin(command.parser("artifacts2022_networks.py", __doc__, writes="networks"), argv)
    options = options_of(job.options)
    elsewhere = job.options.trained_on == "contaminated"
    trained = TrainedRegressions(network_of(options), {}) if elsewhere else learn(job.clean, options)
    write_networks(job.flags.networks, trained)


if __name__ == "__main__":
    main()
