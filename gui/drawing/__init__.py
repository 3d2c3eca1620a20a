"""The preview of drawings, and the choices for them."""
