"""Operations on meshes that nodes hold: repairs, edits of single elements, and meshes made of other nodes."""
