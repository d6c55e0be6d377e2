// A folder for a test's files, gone at its end.
#pragma once

#include "engine/core/scratch_folder.h" // IWYU pragma: export
