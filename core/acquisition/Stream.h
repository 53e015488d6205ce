// Stream.h - the types of a sample stream, from base, where dsp finds them too.
#pragma once

#include "core/base/Stream.h"
