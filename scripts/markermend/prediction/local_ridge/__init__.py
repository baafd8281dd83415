"""Regression of a marker on its neighbours in a local frame on the body, with kriging of the residual."""
