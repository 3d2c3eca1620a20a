"""Operations on outlines: document in, document out. Imports document, outline and the curve mathematics."""
