"""Validate an RO-Crate against a profile, in an environment with the profile's own validator; print a line for each requirement that is not met.

    python crate_validation.py CRATE CONTEXT

CONTEXT is the file with the terms that the crate names by an address. It is read in place of that address, which may be out of reach.
"""

import json
import sys

from rdflib.plugins.parsers import jsonld as parser
from rdflib.plugins.shared.jsonld import context, util

PROFILE = "workflow-run-crate-0.5"
FETCHED = ("ro-crate-1.1_3.1", "ro-crate-1.1_3.2")
"""Checks that the address can be reached."""


def main(crate: str, terms_file: str) -> None:
    with open(terms_file, encoding="utf-8") as file:
        # Version 1.1, which the profile builds on, has these terms at the shorter address.
        terms = json.loads(file.read().replace("https://bioschemas.org/terms/", "https://bioschemas.org/"))
    fetch = util.source_to_json

    def read(source, *more, **named):
        return (terms, None) if "w3id.org/ro/crate" in str(source) else fetch(source, *more, **named)

    for module in (util, context, parser):
        if hasattr(module, "source_to_json"):
            module.source_to_json = read
    # Only now: it keeps the function that it finds.
    from rocrate_validator import models, services

    found = services.validate(services.ValidationSettings(rocrate_uri=crate, profile_identifier=PROFILE))
    issues = [issue for issue in found.get_issues(models.Severity.REQUIRED) if issue.check.identifier not in FETCHED]
    print(*(f"{issue.check.identifier}: {issue.message}" for issue in issues), sep="\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
