// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/actors/rigged_body.h"

#include "cslam/actors/recolor.h"
#include "cslam/actors/rigged_skeleton.h"
#include "cslam/actors/smooth_noise.h"
#include "cslam/io/image_codec.h"
#include "cslam/util/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace cslam {
namespace {

// A part of the man, told by its mesh's name.
struct Part {
  std::string_view name;
  cv::Mat (*recolor)(const cv::Mat& picture, const PersonLook& look);
};

cv::Mat AsItIs(const cv::Mat& picture, const PersonLook& /*look*/) {
  return picture;
}

constexpr std::string_view kTrousers = "-jeans";
constexpr std::string_view kShirt = "-tshirt";
constexpr std::string_view kShoes = "-classic_shoes";
constexpr std::string_view kHair = "-mhair";
constexpr std::array<Part, 6> kParts{{{"-male", RecolorSkin},
                                      {kTrousers, RecolorTrousers},
                                      {kShirt, RecolorShirt},
                                      {kShoes, RecolorShoes},
                                      {kHair, RecolorHair},
                                      {"-eyes", AsItIs}}};

constexpr double kBuildShare = 0.6;     // of the look's build that the whole body takes
constexpr double kBallShare = 0.66;     // from the ankle to the tip of the shoe
constexpr double kBallBlend_m = 0.025;  // half the length over which the shoe bends
constexpr double kHeelInset_m = 0.012;  // the shoe's heel is round
constexpr float kShirtRoom_m = 0.006F;
constexpr float kHairRoom_m = 0.005F;  // over the skull
constexpr float kTuckRoom_m = 0.02F;   // of the trousers under the shirt
constexpr double kTuckBlend_m = 0.03;  // above the shirt's hem

class RigBuilder {
 public:
  RigBuilder(const BlendContents& rig, const PersonLook& look, const std::filesystem::path& file)
      : rig_(rig), look_(look), file_(file) {}

  SkinnedBody Build() {
    Measure();
    body_.skeleton = SkeletonOfRig(rig_, scale_, floor_m_, file_);
    MeasureShoes();
    const double hip_m = body_.skeleton.T_body_joint[kPelvis].translation.z();
    body_.skeleton.buttock_m = kButtockShare * hip_m;
    for (const Part& part : kParts)
      AddPart(part);
    body_.mesh.normals = SmoothNormals(body_.mesh);
    TuckIn();
    CheckBody(body_);
    return std::move(body_);
  }

 private:
  static constexpr double kButtockShare = 0.125;  // of the hip's height: what one sits on

  const BlendMesh& MeshOf(std::string_view part) const {
    for (const BlendMesh& mesh : rig_.meshes) {
      if (mesh.name.find(part) != std::string::npos && !mesh.weights.empty()) return mesh;
    }
    throw Error("'{}' has no mesh '*{}*'; it is not the rig of morse-simulator-data",
                file_.string(), part);
  }

  void Measure() {
    double top_m = -1e9;
    floor_m_ = 1e9;
    for (const Eigen::Vector3f& p : MeshOf(kShoes).positions)
      floor_m_ = std::min(floor_m_, static_cast<double>(p.z()));
    for (const Part& part : kParts) {
      for (const Eigen::Vector3f& p : MeshOf(part.name).positions)
        top_m = std::max(top_m, static_cast<double>(p.z()));
    }
    if (!(top_m - floor_m_ > 0.1)) {
      throw Error("'{}' holds a body of no height; fetch it again", file_.string());
    }
    const double height = look_.height_m / (top_m - floor_m_);
    const double width = height * (1.0 + kBuildShare * (look_.build - 1.0));
    scale_ = {width, width, height};
  }

  Eigen::Vector3f Scaled(const Eigen::Vector3f& p) const {
    const Eigen::Vector3d q = p.cast<double>() - Eigen::Vector3d(0.0, 0.0, floor_m_);
    return q.cwiseProduct(scale_).cast<float>();
  }

  void MeasureShoes() {
    double back_m = 1e9;
    double tip_m = -1e9;
    for (const Eigen::Vector3f& p : MeshOf(kShoes).positions) {
      back_m = std::min(back_m, static_cast<double>(Scaled(p).x()));
      tip_m = std::max(tip_m, static_cast<double>(Scaled(p).x()));
    }
    for (const Side side : kSides) {
      const Eigen::Vector3d ankle = body_.skeleton.T_body_joint[LegOf(side).end].translation;
      body_.skeleton.T_body_joint[ToesOf(side)].translation = {
          std::lerp(ankle.x(), tip_m, kBallShare), ankle.y(), 0.25 * ankle.z()};
      body_.skeleton.heel_m = ankle.x() - back_m - kHeelInset_m;
    }
  }

  // The shoe bends at the ball, for which the rig has no bone.
  void BendToes(const Eigen::Vector3f& position, std::array<float, kNumJoints>& weights) const {
    for (const Side side : kSides) {
      const Joint foot = LegOf(side).end;
      const double ball_m = body_.skeleton.T_body_joint[ToesOf(side)].translation.x();
      const auto share = static_cast<float>(SmoothStep(ball_m - kBallBlend_m, ball_m + kBallBlend_m,
                                                       static_cast<double>(position.x())));
      weights[ToesOf(side)] = share * weights[foot];
      weights[foot] -= weights[ToesOf(side)];
    }
  }

  Influence InfluenceOf(const BlendMesh& mesh, std::uint32_t vertex) const {
    std::array<float, kNumJoints> weights{};
    for (const BlendWeight& weight : mesh.weights[vertex])
      weights[JointOfGroup(mesh.groups[static_cast<std::size_t>(weight.group)])] += weight.weight;
    BendToes(Scaled(mesh.positions[vertex]), weights);
    std::array<std::uint8_t, kNumJoints> order;
    for (std::size_t j = 0; j < kNumJoints; ++j)
      order[j] = static_cast<std::uint8_t>(j);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint8_t a, std::uint8_t b) { return weights[a] > weights[b]; });
    float sum = 0.0F;
    for (std::size_t k = 0; k < kMaxInfluences; ++k)
      sum += weights[order[k]];
    if (!(sum > 0.0F)) return Only(kHead);
    Influence influence;
    for (std::size_t k = 0; k < kMaxInfluences; ++k) {
      influence.joints[k] = order[k];
      influence.weights[k] = weights[order[k]] / sum;
    }
    return influence;
  }

  int AddPicture(const BlendMesh& mesh, const Part& part) {
    int image = -1;
    for (const BlendPolygon& polygon : mesh.polygons) {
      if (polygon.material >= 0)
        image = rig_.materials[static_cast<std::size_t>(polygon.material)].image;
      if (image >= 0) break;
    }
    if (image < 0 || rig_.images[static_cast<std::size_t>(image)].bytes.empty()) {
      throw Error("'{}' has no picture for mesh '{}'; it is not the rig of morse-simulator-data",
                  file_.string(), mesh.name);
    }
    const BlendImage& packed = rig_.images[static_cast<std::size_t>(image)];
    body_.pictures.push_back(
        part.recolor(DecodeColorImage(packed.bytes, file_ / packed.name), look_));
    return static_cast<int>(body_.pictures.size()) - 1;
  }

  void Inflate(std::string_view part, float room_m) {
    const auto [begin, end] = ranges_.at(part);
    for (std::size_t i = begin; i < end; ++i)
      body_.mesh.positions[i] += room_m * body_.mesh.normals[i];
  }

  // The shirt hangs over the trousers: without some room between them, the one comes through the
  // other when the body bends. The same for the hair.
  void TuckIn() {
    const auto& positions = body_.mesh.positions;
    float hem_m = std::numeric_limits<float>::max();
    for (std::size_t i = ranges_.at(kShirt).first; i < ranges_.at(kShirt).second; ++i)
      hem_m = std::min(hem_m, positions[i].z());
    Inflate(kShirt, kShirtRoom_m);
    Inflate(kHair, kHairRoom_m);
    const auto [begin, end] = ranges_.at(kTrousers);
    for (std::size_t i = begin; i < end; ++i) {
      const auto share = static_cast<float>(
          SmoothStep(0.0, kTuckBlend_m, static_cast<double>(positions[i].z() - hem_m)));
      body_.mesh.positions[i] -= share * kTuckRoom_m * body_.mesh.normals[i];
    }
  }

  void AddPart(const Part& part) {
    const BlendMesh& mesh = MeshOf(part.name);
    const int picture = AddPicture(mesh, part);
    const std::size_t begin = body_.mesh.positions.size();
    using Corner = std::tuple<std::uint32_t, float, float>;
    std::map<Corner, std::uint32_t> known;
    const auto vertex_of = [&](const BlendCorner& corner) {
      const auto next = static_cast<std::uint32_t>(body_.mesh.positions.size());
      const auto [place, is_new] =
          known.try_emplace({corner.vertex, corner.uv.x(), corner.uv.y()}, next);
      if (is_new) {
        body_.mesh.positions.push_back(Scaled(mesh.positions[corner.vertex]));
        body_.mesh.uvs.push_back({corner.uv.x(), 1.0F - corner.uv.y()});
        body_.influences.push_back(InfluenceOf(mesh, corner.vertex));
      }
      return place->second;
    };
    for (const BlendPolygon& polygon : mesh.polygons) {
      const std::uint32_t first = vertex_of(polygon.corners[0]);
      for (std::size_t i = 2; i < polygon.corners.size(); ++i) {
        const std::uint32_t second = vertex_of(polygon.corners[i - 1]);
        body_.mesh.triangles.push_back({{first, second, vertex_of(polygon.corners[i])}, picture});
      }
    }
    ranges_[part.name] = {begin, body_.mesh.positions.size()};
  }

  const BlendContents& rig_;
  const PersonLook& look_;
  const std::filesystem::path& file_;
  Eigen::Vector3d scale_ = Eigen::Vector3d::Ones();
  double floor_m_ = 0.0;
  SkinnedBody body_;
  std::map<std::string_view, std::pair<std::size_t, std::size_t>> ranges_;  // vertices of the parts
};

}  // namespace

SkinnedBody MakeRiggedBody(const BlendContents& rig, const PersonLook& look,
                           const std::filesystem::path& file) {
  return RigBuilder(rig, look, file).Build();
}

}  // namespace cslam
