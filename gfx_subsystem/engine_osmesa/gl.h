// OpenGL and OSMesa with the prototypes of everything up to the version the engine asks for; libOSMesa exports them
// all.
#pragma once

#ifndef GL_GLEXT_PROTOTYPES
#define GL_GLEXT_PROTOTYPES 1
#endif
#include <GL/osmesa.h>

#include <GL/glext.h>
