// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/make_detector.h"

#include "cslam/io/truth_files.h"
#include "cslam/semantics/dnn_detector.h"
#include "cslam/semantics/model_store.h"
#include "cslam/semantics/recorded_detector.h"
#include "cslam/util/check.h"

#include <optional>
#include <utility>

namespace cslam {
namespace {

MadeDetector MakeNull(std::string warning) {
  return {std::make_unique<NullDetector>(), std::move(warning)};
}

MadeDetector MakeDnn(const DetectorOptions& options) {
  std::optional<ModelDescription> model;
  if (options.model.empty()) {
    model = FindBestModel(ModelFolders());
  } else {
    model = FindModel(options.model, ModelFolders());
  }
  if (!model) return MakeNull(NoModelMessage() + "; going on without detection");
  ApplyOptions(options, *model);
  return {std::make_unique<DnnDetector>(*std::move(model), options.threads), ""};
}

MadeDetector MakeRecorded(const DetectorOptions& options) {
  if (options.detections.empty())
    throw Error("detector 'recorded' needs --detections FILE (a detections.json)");
  DetectionRecord record = ReadDetections(options.detections);
  ApplyOptions(options, record);
  return {
      std::make_unique<RecordedDetector>(std::move(record), options.detections, options.degrade),
      ""};
}

}  // namespace

MadeDetector MakeDetector(const DetectorOptions& options) {
  if (options.kind != "recorded" && !options.detections.empty())
    throw Error("a file of detections is for detector 'recorded', not '{}'", options.kind);
  if (options.kind == "none") return MakeNull("");
  if (options.kind == "dnn") return MakeDnn(options);
  if (options.kind == "recorded") return MakeRecorded(options);
  throw Error("unknown detector '{}': dnn, recorded or none", options.kind);
}

}  // namespace cslam
