// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
//
// What a frame costs to render, stage by stage, on a procedural room with two walking bodies of
// 10,000 triangles each.
#include "cslam/io/image_codec.h"
#include "cslam/sim/furniture.h"
#include "cslam/sim/moving_scene.h"
#include "cslam/sim/renderer.h"
#include "cslam/sim/room.h"
#include "cslam/sim/simulated_sequence.h"

#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>

#include <filesystem>
#include <numbers>
#include <optional>

namespace cslam {
namespace {

constexpr int kFrame = 45;

// A capsule of 1.7 m, smooth, about as finely meshed as a person.
Mesh MakeCapsule(int material) {
  constexpr int kRings = 70;
  constexpr int kSides = 72;
  constexpr float kRadiusM = 0.22F;
  Mesh mesh;
  for (int r = 0; r <= kRings; ++r) {
    const float height = static_cast<float>(r) / kRings;
    const float width =
        kRadiusM * std::sqrt(std::max(0.01F, 1.0F - std::pow(2.0F * height - 1.0F, 8.0F)));
    for (int s = 0; s <= kSides; ++s) {
      const float angle_rad = 2.0F * std::numbers::pi_v<float> * static_cast<float>(s) / kSides;
      const Eigen::Vector3f side(std::cos(angle_rad), std::sin(angle_rad), 0.0F);
      mesh.positions.push_back(width * side + Eigen::Vector3f(0.0F, 0.0F, 1.7F * height));
      mesh.normals.push_back(side);
      mesh.uvs.emplace_back(static_cast<float>(s) / kSides, height);
    }
  }
  for (std::uint32_t r = 0; r < kRings; ++r) {
    for (std::uint32_t s = 0; s < kSides; ++s) {
      const std::uint32_t a = r * (kSides + 1) + s;
      const std::uint32_t b = a + kSides + 1;
      mesh.triangles.push_back({{a, a + 1, b}, material});
      mesh.triangles.push_back({{a + 1, b + 1, b}, material});
    }
  }
  return mesh;
}

World MakeWorld(int num_bodies) {
  World world{MakeRoom({}), {}, {}};
  for (int i = 0; i < num_bodies; ++i) {
    const Mesh mesh = MakeCapsule(5 + i);
    world.scene.objects.push_back({"person", 0, Se3(), mesh});
    const int instance = static_cast<int>(world.scene.objects.size()) - 1;
    world.animations[instance] = [mesh, i](double time_s) -> std::optional<BodyShape> {
      BodyShape shape{mesh.positions, mesh.normals,
                      Standing(3.6 + 0.8 * i, 3.2 + 0.2 * std::sin(time_s), 0.0)};
      for (Eigen::Vector3f& p : shape.positions)
        p += shape.T_world_body.translation.cast<float>();
      return shape;
    };
  }
  return world;
}

const SimulatedSequence& Sequence(int num_bodies) {
  SequenceOptions options;
  options.noise = SensorNoise::kD435i;
  options.shutter_s = kUsualShutterS;
  static const SimulatedSequence empty(MakeWorld(0), MakeDemoPath(1).Motion(), options);
  static const SimulatedSequence people(MakeWorld(2), MakeDemoPath(1).Motion(), options);
  return num_bodies == 0 ? empty : people;
}

void BM_BakeFromNothing(benchmark::State& state) {
  const World& world = Sequence(2).world();
  for (auto _ : state)
    benchmark::DoNotOptimize(RestingScene(world, 0.0));
}
BENCHMARK(BM_BakeFromNothing)->Unit(benchmark::kMillisecond)->Iterations(1);

void BM_MoverScene(benchmark::State& state) {
  const World& world = Sequence(2).world();
  const RestingScene resting(world, 0.0);
  for (auto _ : state)
    benchmark::DoNotOptimize(MovingScene(world, 1.0, resting));
}
BENCHMARK(BM_MoverScene)->Unit(benchmark::kMillisecond);

void BM_Render(benchmark::State& state) {
  const SimulatedSequence& sequence = Sequence(static_cast<int>(state.range(0)));
  benchmark::DoNotOptimize(sequence.Truth(kFrame));
  int i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(sequence.Truth(kFrame + i++ % 10));
}
BENCHMARK(BM_Render)->ArgName("bodies")->Arg(0)->Arg(2)->Unit(benchmark::kMillisecond);

void BM_Sensor(benchmark::State& state) {
  const SimulatedSequence& sequence = Sequence(2);
  const RenderedView truth = sequence.Truth(kFrame);
  for (auto _ : state)
    benchmark::DoNotOptimize(sequence.Observe(kFrame, truth));
}
BENCHMARK(BM_Sensor)->Unit(benchmark::kMillisecond);

void BM_Png(benchmark::State& state) {
  const SimulatedSequence& sequence = Sequence(2);
  const RenderedView truth = sequence.Truth(kFrame);
  const RgbdFrame frame = sequence.Observe(kFrame, truth);
  cv::Mat depth_units;
  frame.depth_m.convertTo(depth_units, CV_16U, 5000.0);
  cv::Mat instances;
  truth.instances.convertTo(instances, CV_8U);
  const cv::Mat& image =
      state.range(0) == 0 ? frame.bgr : (state.range(0) == 1 ? depth_units : instances);
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "cslam_bench.png";
  for (auto _ : state)
    WritePng(file, image);
  state.counters["kB"] = static_cast<double>(std::filesystem::file_size(file)) / 1000.0;
  std::filesystem::remove(file);
}
BENCHMARK(BM_Png)->ArgName("rgb_depth_instances")->DenseRange(0, 2)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cslam

BENCHMARK_MAIN();
