// SPDX-License-Identifier: BSD-3-Clause
// The public recordings of the paper's Table II and where their publishers keep them. They publish no
// checksums, so none stand here: what is verified is the size that the server tells, the checksum that gzip
// keeps of its content, and that the unpacked folder is a dataset with ground truth.
#pragma once

#include <array>
#include <string_view>

namespace sslam::cli {

struct PublicSequence {
  std::string_view name;     // as in the paper
  std::string_view folder;   // that it becomes
  std::string_view place;    // address of the archive's folder
  std::string_view archive;  // its file there
  std::string_view terms;
};

inline constexpr std::string_view kIclPlace = "https://www.doc.ic.ac.uk/~ahanda/";
inline constexpr std::string_view kTumPlace = "https://cvg.cit.tum.de/rgbd/dataset/freiburg3/";
inline constexpr std::string_view kIclTerms = "ICL-NUIM, CC BY 3.0";
inline constexpr std::string_view kTumTerms = "TUM RGB-D, CC BY 4.0";

inline constexpr std::array<PublicSequence, 10> kPublicSequences{{
    {"lr-kt1", "living_room_traj1_frei_png", kIclPlace, "living_room_traj1_frei_png.tar.gz", kIclTerms},
    {"lr-kt2", "living_room_traj2_frei_png", kIclPlace, "living_room_traj2_frei_png.tar.gz", kIclTerms},
    {"lr-kt3", "living_room_traj3_frei_png", kIclPlace, "living_room_traj3_frei_png.tar.gz", kIclTerms},
    {"of-kt1", "traj1_frei_png", kIclPlace, "traj1_frei_png.tar.gz", kIclTerms},
    {"of-kt2", "traj2_frei_png", kIclPlace, "traj2_frei_png.tar.gz", kIclTerms},
    {"of-kt3", "traj3_frei_png", kIclPlace, "traj3_frei_png.tar.gz", kIclTerms},
    {"s-t-near", "rgbd_dataset_freiburg3_structure_texture_near", kTumPlace,
     "rgbd_dataset_freiburg3_structure_texture_near.tgz", kTumTerms},
    {"s-t-far", "rgbd_dataset_freiburg3_structure_texture_far", kTumPlace,
     "rgbd_dataset_freiburg3_structure_texture_far.tgz", kTumTerms},
    {"s-not-near", "rgbd_dataset_freiburg3_structure_notexture_near", kTumPlace,
     "rgbd_dataset_freiburg3_structure_notexture_near.tgz", kTumTerms},
    {"s-not-far", "rgbd_dataset_freiburg3_structure_notexture_far", kTumPlace,
     "rgbd_dataset_freiburg3_structure_notexture_far.tgz", kTumTerms},
}};

}  // namespace sslam::cli
