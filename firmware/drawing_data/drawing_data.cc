#include "firmware/drawing_data/drawing_data.h"
