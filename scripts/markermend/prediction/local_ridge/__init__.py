"""Ridge regression in a frame on the body, and the residual carried on by kriging."""
