"""How faces take light: the shader of the textbook's intensity equation, textures, bumps, lights."""
