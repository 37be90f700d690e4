// Libjpeg's way to report, for whoever calls it: an error leaves the call by longjmp with its text, and
// nothing is printed. Before: jpeg_error_mgr. After: jpeg_header, jpeg_decoder. Nothing with a destructor may
// live between setjmp(failure.jump) and a call of the library.
#pragma once

#include <csetjmp>
#include <cstdio>

// After <cstdio>, which it needs and does not include.
#include <jerror.h>
#include <jpeglib.h>

namespace herr {

struct JpegFailure {
  jpeg_error_mgr manager{};  // first: libjpeg hands back a pointer to it
  std::jmp_buf jump{};
  char message[JMSG_LENGTH_MAX] = "";
};

[[noreturn]] inline void leave_jpeg(j_common_ptr info) {
  auto* failure = reinterpret_cast<JpegFailure*>(info->err);
  info->err->format_message(info, failure->message);
  std::longjmp(failure->jump, 1);
}

// libjpeg goes on after what it warns of (bytes too many, unknown tags), and so do we.
inline void pass_over_jpeg_warning(j_common_ptr) {}

// Data that end early are a warning to it, and it would fill up with grey: that is an error to us.
inline void leave_where_jpeg_ends_early(j_common_ptr info, int level) {
  if (level < 0 && info->err->msg_code == JWRN_JPEG_EOF) leave_jpeg(info);
}

// What `info.err` is to be.
inline jpeg_error_mgr* report_to(JpegFailure& failure) {
  jpeg_error_mgr* manager = jpeg_std_error(&failure.manager);
  manager->error_exit = leave_jpeg;
  manager->output_message = pass_over_jpeg_warning;
  return manager;
}

}  // namespace herr
