#include "terrain/raster/gdal_messages.h"

#include <cpl_error.h>
#include <gdal.h>

#include <mutex>

namespace fanbeam::terrain {
namespace {

void collect(CPLErr severity, CPLErrorNum, const char* text) {
  if (severity < CE_Failure) return;
  static_cast<GdalMessages*>(CPLGetErrorHandlerUserData())->add_error(text);
}

}  // namespace

GdalMessages::GdalMessages() {
  static std::once_flag registered;
  std::call_once(registered, GDALAllRegister);
  CPLPushErrorHandlerEx(collect, this);
}

GdalMessages::~GdalMessages() { CPLPopErrorHandler(); }

std::string GdalMessages::first_error_or(const std::string& otherwise) const {
  return has_errors() ? first_error_ : otherwise;
}

void GdalMessages::add_error(const char* text) {
  if (first_error_.empty()) first_error_ = text;
}

}  // namespace fanbeam::terrain
