"""What stands on the table: types, relations, the service that publishes it."""
