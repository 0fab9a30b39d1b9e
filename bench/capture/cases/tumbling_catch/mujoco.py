"""MuJoCo."""

REASON = "expressible with rigid links and spatial tendons; nobody has written it yet"
