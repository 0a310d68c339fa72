"""What a user is told when the input is at fault."""


class InputError(ValueError):
    """Bad input, told in one sentence: which file, which key, what was found, what is allowed."""
