// Precompiled headers need a source of their own.
