"""MuJoCo."""

REASON = "a contact without loss has no friction in MuJoCo 2.2.2: one damping (solref) serves both"
