// The only file that contains stb_image_write.
#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/gpu/picture.h"

#include <string>

#ifdef __clang_analyzer__ // not ours to mend
using stbi_write_func = void(void* context, void* data, int size);
int stbi_write_png_to_func(stbi_write_func* write, void* context, int width, int height, int channels,
                           const void* pixels, int stride);
#else
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>
#pragma GCC diagnostic pop
#endif

namespace anvil {

void write_png(const std::string& path, const Picture& picture) {
    std::string bytes;
    const auto append = [](void* context, void* data, int size) {
        static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<size_t>(size));
    };
    const auto width = static_cast<int>(picture.width);
    const int encoded = stbi_write_png_to_func(append, &bytes, width, static_cast<int>(picture.height), 4,
                                               picture.rgba.data(), 4 * width);
    if (encoded == 0) {
        throw WriteError("cannot encode the picture " + path);
    }
    write_file_atomically(path, bytes);
}

} // namespace anvil
