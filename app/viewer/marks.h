// Marks over the picture at places of the scene: handles, lines, pins, contact. They are as large in pixels
// wherever they are, and faint where the surface hides them.
#pragma once

#include "app/viewer/orbit_camera.h"
#include "app/viewer/scene.h"

#include <vector>

namespace anvil {

namespace shader {
using glm::vec4;
using uint = uint32_t;
#include "shaders/viewer/mark.h"
} // namespace shader

class Marks {
  public:
    /// Colours: red in the lowest eight bits, then green, blue and opacity, as ImGui's.
    using Colour = uint32_t;

    /// Seen by the camera, over the scene. Both outlive this.
    Marks(const OrbitCamera& camera, const Scene& scene) : camera_(camera), scene_(scene) {}

    // What lies behind the eye is left out. Lengths in pixels of a display of 96 dots an inch. Later ones lie
    // over earlier ones.
    void disc(const Vec3& place, double radius, Colour colour);
    void ring(const Vec3& place, double radius, double width, Colour colour);
    void square(const Vec3& place, double half, Colour colour);
    void line(const Vec3& a, const Vec3& b, double width, Colour colour);
    void facet(const Vec3& a, const Vec3& b, const Vec3& c, Colour colour);
    /// Of three sides, about the place.
    void triangle(const Vec3& place, double radius, double width, Colour colour);

    const OrbitCamera& camera() const { return camera_; }
    const std::vector<shader::Mark>& all() const { return all_; }

  private:
    /// x, y, depth; nothing behind the eye.
    std::optional<glm::vec3> seen(const Vec3& place) const;
    void add(uint32_t kind, Colour colour, glm::vec4 a, glm::vec4 b = glm::vec4(0),
             const glm::vec4& c = glm::vec4(0));

    const OrbitCamera& camera_;
    const Scene& scene_;
    std::vector<shader::Mark> all_;
};

} // namespace anvil
