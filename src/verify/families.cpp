// SPDX-License-Identifier: Apache-2.0
#include "verify/families.h"

namespace tyndall::verify {

using render::Method;

MomentOptions by(Method method, MomentOptions options) {
  options.estimator.method = method;
  return options;
}

std::vector<MomentOptions> everyMethod(const MomentOptions& options) {
  return {by(Method::March), by(Method::Tracking, options), by(Method::Path, options)};
}

std::string nameOf(const MomentOptions& options) { return render::methodName(options.estimator.method); }

} // namespace tyndall::verify
