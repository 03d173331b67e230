// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/semantics/dnn_detector.h"

#include "cslam/semantics/decoder.h"
#include "cslam/semantics/input_geometry.h"
#include "cslam/semantics/nms.h"
#include "cslam/util/check.h"

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cslam {
namespace {

constexpr int kNumChannels = 3;

// OpenCV prints several lines of its own for what becomes one Error here.
class QuietOpenCv {
 public:
  QuietOpenCv() : level_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
  ~QuietOpenCv() { cv::utils::logging::setLogLevel(level_); }
  QuietOpenCv(const QuietOpenCv&) = delete;
  QuietOpenCv& operator=(const QuietOpenCv&) = delete;

 private:
  cv::utils::logging::LogLevel level_;
};

// On one line.
std::string Reason(const cv::Exception& error) {
  std::string text = error.err.empty() ? error.what() : error.err;
  std::ranges::replace(text, '\n', ' ');
  return text;
}

cv::dnn::Net ReadNetwork(const ModelDescription& model) {
  std::error_code ignored;
  if (!std::filesystem::exists(model.onnx_file, ignored)) {
    throw Error("there is no network '{}'{}", model.onnx_file.string(),
                model.description_file.empty()
                    ? ""
                    : ", which " + model.description_file.string() + " describes");
  }
  try {
    cv::dnn::Net network = cv::dnn::readNetFromONNX(model.onnx_file.string());
    if (network.empty()) throw Error("'{}' holds no network", model.onnx_file.string());
    network.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    network.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
    return network;
  } catch (const cv::Exception& error) {
    throw Error("cannot read '{}' as an ONNX network: {}", model.onnx_file.string(), Reason(error));
  }
}

cv::Mat ColorOf(const RgbdFrame& frame) {
  if (!frame.bgr.empty()) return frame.bgr;
  CSLAM_CHECK(!frame.gray.empty(), "frame {} has no image", frame.id.value());
  cv::Mat color;
  cv::cvtColor(frame.gray, color, cv::COLOR_GRAY2BGR);
  return color;
}

// The image at the input's size, CV_8UC3 in its own order of channels.
cv::Mat Resized(const ModelDescription& model, const InputGeometry& geometry,
                const cv::Mat& image) {
  const cv::Size content(geometry.content_width_px, geometry.content_height_px);
  cv::Mat resized;
  cv::resize(image, resized, content, 0.0, 0.0, cv::INTER_LINEAR);
  if (content == cv::Size(model.width_px, model.height_px)) return resized;
  cv::Mat input(model.height_px, model.width_px, CV_8UC3, cv::Scalar::all(model.pad_value));
  resized.copyTo(input(cv::Rect({geometry.offset_x_px, geometry.offset_y_px}, content)));
  return input;
}

// 1 x 3 x height x width, CV_32F.
cv::Mat MakeBlob(const ModelDescription& model, const cv::Mat& input) {
  const std::array<int, 4> shape{1, kNumChannels, input.rows, input.cols};
  cv::Mat blob(static_cast<int>(shape.size()), shape.data(), CV_32F);
  std::array<cv::Mat, kNumChannels> planes;
  cv::split(input, planes.data());
  for (int c = 0; c < kNumChannels; ++c) {
    const auto channel = static_cast<std::size_t>(c);
    const cv::Mat& plane = planes[model.is_rgb ? kNumChannels - 1 - channel : channel];
    cv::Mat target(input.rows, input.cols, CV_32F, blob.ptr<float>(0, c));
    const double scale = 1.0 / model.deviation[channel];
    plane.convertTo(target, CV_32F, scale, -model.mean[channel] * scale);
  }
  return blob;
}

TensorView ViewOf(const cv::Mat& output) {
  CSLAM_CHECK(output.type() == CV_32F && output.isContinuous());
  return {std::vector<int>(output.size.p, output.size.p + output.dims),
          {output.ptr<float>(), output.total()}};
}

}  // namespace

struct DnnDetector::Network {
  cv::dnn::Net net;
  std::vector<cv::String> output_names;

  std::vector<cv::Mat> Run(const ModelDescription& model, const cv::Mat& blob) {
    std::vector<cv::Mat> outputs;
    try {
      net.setInput(blob);
      net.forward(outputs, output_names);
    } catch (const cv::Exception& error) {
      throw Error("'{}' cannot be run on an input of {} x {}: {}", model.onnx_file.string(),
                  model.width_px, model.height_px, Reason(error));
    }
    return outputs;
  }
};

DnnDetector::DnnDetector(ModelDescription model, int num_threads)
    : model_(std::move(model)), network_(std::make_unique<Network>()) {
  cv::setNumThreads(num_threads);
  const QuietOpenCv quiet;
  network_->net = ReadNetwork(model_);
  network_->output_names = network_->net.getUnconnectedOutLayersNames();
  RgbdFrame grey;  // whatever does not fit shows now, not in the middle of a run
  grey.bgr = cv::Mat(model_.height_px, model_.width_px, CV_8UC3, cv::Scalar::all(128.0));
  Detect(grey);
}

DnnDetector::~DnnDetector() = default;

Detections DnnDetector::Detect(const RgbdFrame& frame) {
  const cv::Mat image = ColorOf(frame);
  const InputGeometry geometry =
      FitImage(model_.resize, image.cols, image.rows, model_.width_px, model_.height_px);
  const std::vector<cv::Mat> outputs =
      network_->Run(model_, MakeBlob(model_, Resized(model_, geometry, image)));
  std::vector<TensorView> views;
  for (const cv::Mat& output : outputs)
    views.push_back(ViewOf(output));
  std::vector<Detection> candidates = DecodeOutputs(model_, views);
  for (Detection& candidate : candidates)
    candidate.box = ToImage(geometry, candidate.box);
  return {frame.id, frame.stamp,
          SuppressNonMaxima(std::move(candidates), model_.nms_iou, kMaxDetections)};
}

DetectorInfo DnnDetector::info() const {
  return {.kind = "dnn", .name = model_.name, .source = model_.onnx_file.string()};
}

}  // namespace cslam
