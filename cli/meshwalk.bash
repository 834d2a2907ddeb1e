# Bash completion for meshwalk.
