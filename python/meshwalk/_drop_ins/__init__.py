"""What drop-ins share."""
