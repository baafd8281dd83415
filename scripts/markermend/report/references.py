"""What texts cite, and the numbers that they cite it by."""

from __future__ import annotations

from markermend import __version__

REFERENCES = {
    "software": f"markermend, version {__version__}: cleaning of optical motion capture. The markermend developers.",
    "artifacts": "Skurowski P, Pawlyta M. Detection and classification of artifact distortions in optical motion "
    "capture sequences. Sensors 2022; 22(11): 4076. https://doi.org/10.3390/s22114076",
    "mesh": "Skurowski P, Pawlyta M. Gap reconstruction in optical motion capture sequences using neural networks. "
    "Sensors 2021; 21(18): 6115. https://doi.org/10.3390/s21186115",
    "averaging": "Tits M, Tilmanne J, Dutoit T. Robust and automatic motion-capture data recovery using soft skeleton "
    "constraints and model averaging. PLoS ONE 2018; 13(7): e0199744. https://doi.org/10.1371/journal.pone.0199744",
}
"""What is cited, by the key that a sentence uses."""


class Citations:
    """Numbers of the references in the order in which a text cites them.

    Attributes
    ----------
    keys : list of str
        The keys of REFERENCES that are cited so far.
    """

    def __init__(self) -> None:
        self.keys: list[str] = []

    def cite(self, key: str) -> str:
        """Cite a reference.

        Parameters
        ----------
        key : str
            A key of REFERENCES.

        Returns
        -------
        str
            The number in brackets.
        """
        if key not in self.keys:
            self.keys.append(key)
        return f"[{self.keys.index(key) + 1}]"
