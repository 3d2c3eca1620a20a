"""The Clearance panel: pairs of solids that overlap or come too near, listed, shown and told what is asked of them."""
