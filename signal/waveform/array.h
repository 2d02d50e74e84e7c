// Where the transmitters and receivers of a radar sit, and the virtual elements they make.
//
// Virtual element (t, r) sits at p_t + p_r: in the far field the two-way length to a scatterer in
// direction u is 2 R - u . (p_t + p_r). The phase of a beat signal grows with the length
// (synthesis/beat_phase.h), so element p leads by -2 pi (u . p) / lambda: a scatterer to the right
// turns the phase of elements to the right backwards.
// Axes: forward (boresight), right, up, as in sensors/antenna/antenna_frame.h, scan surface
// "plane": u = (cos el cos az, cos el sin az, sin el); azimuth positive right, elevation positive
// up.
// Source of the default: 3 transmitters x 4 receivers, 12 virtual elements at half a wavelength, as
// in automotive MIMO radars (Texas Instruments SWRA554A).
// Neglected: coupling between elements, and their patterns (part of a path's amplitude).
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace fanbeam::signal {

// How echoes of different transmitters are told apart.
enum class Multiplex {
  time_division,  // one transmitter per slot; a chirp of the cube is one slot of each
  simultaneous,   // ideal orthogonal codes: all at once, without crosstalk
};

struct Array {
  // From the array's origin: forward, right, up.
  std::vector<glm::dvec3> transmitters_m = {glm::dvec3(0.0)};
  std::vector<glm::dvec3> receivers_m = {glm::dvec3(0.0)};
  Multiplex multiplex = Multiplex::time_division;

  int channels() const {
    return static_cast<int>(transmitters_m.size()) * static_cast<int>(receivers_m.size());
  }
  // Channel of a cube: transmitter * receivers + receiver.
  int transmitter_of(int channel) const { return channel / static_cast<int>(receivers_m.size()); }
  int receiver_of(int channel) const { return channel % static_cast<int>(receivers_m.size()); }
  // Slots a waveform needs for one chirp of every transmitter.
  int slots() const {
    return multiplex == Multiplex::simultaneous ? 1 : static_cast<int>(transmitters_m.size());
  }
};

// A line across the boresight whose transmitters x receivers virtual elements are `pitch_m` apart,
// in the order of channels from left to right, centred on the origin: receivers at the pitch,
// transmitters at receivers x pitch. Refuses counts below 1 or above 256 and a pitch that is not
// positive and finite.
Array line_array(int transmitters, int receivers, double pitch_m);

// Position of every channel's virtual element.
std::vector<glm::dvec3> virtual_elements_m(const Array& array);

// Whether the elements stand on a line at one pitch, in order.
bool is_uniform_line(const std::vector<glm::dvec3>& elements_m);

// The largest |cos(elevation) sin(azimuth)| of a direction that no nearer one to boresight looks like: wavelength /
// (2 pitch) of a uniform line across the boresight, at most 1; 1 of every other array, whatever it leaves ambiguous.
double unambiguous_sine(const std::vector<glm::dvec3>& elements_m, double wavelength_m);

// Throws InputError: no transmitter or receiver, more than 4096 channels, a position not finite.
void check(const Array& array);

// Unit vector towards a direction.
glm::dvec3 direction(double azimuth_rad, double elevation_rad);

}  // namespace fanbeam::signal
