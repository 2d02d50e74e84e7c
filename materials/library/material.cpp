#include "materials/library/material.h"

#include "core/errors.h"

namespace fanbeam::materials {

const char* name_of(Confidence confidence) {
  switch (confidence) {
    case Confidence::seen:
      return "seen";
    case Confidence::fitted:
      return "fitted";
    case Confidence::recalled:
      return "recalled";
    case Confidence::assumed:
      return "assumed";
  }
  throw core::InternalError("confidence out of its enumeration");
}

}  // namespace fanbeam::materials
