#include "tb/report/html/report_file.hpp"

#include "tb/report/html/page.hpp"

namespace dsdpv1::tb::html {

ReportFile::ReportFile(const std::string& path, const scenario::Scenario& scenario, RunOptions& options)
    : file_(path), recorder_(scenario) {
  options.observers.push_back(&recorder_);
}

void ReportFile::write(const RunResult& result, const std::string& version) {
  recorder_.finish();
  file_.write(page(result, recorder_, version));
  file_.commit();
}

}  // namespace dsdpv1::tb::html
