"""Options of the predictors, one module per family of models."""
