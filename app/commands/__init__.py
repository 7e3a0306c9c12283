"""One file per family of verbs; `app/cli.py` names them and loads the one that was asked for."""
