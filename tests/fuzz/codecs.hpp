#pragma once

// For the harnesses that have the functions of the image library in them.

#include "common/image/image_codecs.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" const lightwalk::ImageCodecs* lightwalk_image_codecs();
