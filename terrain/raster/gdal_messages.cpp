#include "terrain/raster/gdal_messages.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_http.h>
#include <gdal.h>

#include <mutex>

namespace fanbeam::terrain {
namespace {

void collect(CPLErr severity, CPLErrorNum, const char* text) {
  if (severity < CE_Failure) return;
  static_cast<GdalMessages*>(CPLGetErrorHandlerUserData())->add_error(text);
}

// A GeoJSON file may name its reference system by a URL, which GDAL would ask. An answer that there
// is none, for without an answer GDAL goes on to the network.
CPLHTTPResult* refuse_network(const char* url, CSLConstList, GDALProgressFunc, void*,
                              CPLHTTPFetchWriteFunc, void*, void*) {
  CPLError(CE_Failure, CPLE_NotSupported, "\"%s\" is on the network, which is never asked", url);
  auto* none = static_cast<CPLHTTPResult*>(CPLCalloc(1, sizeof(CPLHTTPResult)));
  none->nStatus = 1;
  none->pszErrBuf = CPLStrdup("the network is never asked");
  return none;
}

}  // namespace

GdalMessages::GdalMessages() {
  static std::once_flag registered;
  std::call_once(registered, GDALAllRegister);
  CPLPushErrorHandlerEx(collect, this);
  CPLHTTPPushFetchCallback(refuse_network, nullptr);
}

GdalMessages::~GdalMessages() {
  CPLHTTPPopFetchCallback();
  CPLPopErrorHandler();
}

std::string GdalMessages::first_error_or(const std::string& otherwise) const {
  return has_errors() ? first_error_ : otherwise;
}

void GdalMessages::add_error(const char* text) {
  if (first_error_.empty()) first_error_ = text;
}

}  // namespace fanbeam::terrain
