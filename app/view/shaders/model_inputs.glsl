// Inputs of a model's fragments (lens_model.cpp). TISSUE: a tissue; otherwise steel.
steady vec3 modelColour, lightColour, surround;
steady float lensScale, windowRadius, lightReach, gain, relit;
#ifdef TISSUE
#define ROD
steady vec3 rodFrom, rodTo, headFrom, headTo;
steady float rodRadius, headRadius;
#else
steady float rodLength, etchedRings;
#endif
#ifdef LENS
steady float lensOutward[10], lensEnd;
steady vec2 lensAxis;
#endif
