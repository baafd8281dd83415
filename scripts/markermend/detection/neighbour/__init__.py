"""Detection in the residual of a prediction from the neighbours."""
