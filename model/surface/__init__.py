"""What surfaces look like: materials, how bitmaps lie on faces, lights, the intensity equation.

Plain NumPy; imports errors, colours and numbers of the document, and model/image.
"""
