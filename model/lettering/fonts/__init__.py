"""Font files opened, found, kept with projects and edited. Imports nothing but `model`, fontTools and HarfBuzz."""
