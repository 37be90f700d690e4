// Limits of the numbers in a scene document. Beyond them a scene is refused with the field's name.
#pragma once

namespace herr {

inline constexpr double kFarthestPlace_m = 1e9;  // of anything that a document places
inline constexpr double kLargest_m = 1e9;        // of a size or radius; of a scale likewise
inline constexpr double kBrightest = 1e9;        // W/m^2 and radiance
inline constexpr double kStrongest_w_sr = 1e24;  // grows with the square of a scene's size
inline constexpr double kLatest_s = 4e9;         // of a timeline or path: the latest stamp of a session

}  // namespace herr
