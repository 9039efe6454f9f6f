#include "lab/campaign/slurm.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "io/input/input_error.hpp"
#include "io/input/units.hpp"
#include "io/output/shell_word.hpp"
#include "io/output/write_file.hpp"
#include "lab/campaign/fingerprint.hpp"

namespace dsdpv1::tb::campaign {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Answer {
  bool good = false;
  std::string text;
};

Answer ask(const std::string& command) {
  std::FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return {};
  Answer answer;
  std::array<char, 4096> block{};
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), pipe))
    answer.text.append(block.data(), count);
  const int status = pclose(pipe);
  answer.good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return answer;
}

std::optional<Submission> submission_of(const fs::path& file) {
  const Json json = read_json(file.string());
  try {
    return Submission{std::stoi(file.stem().string()), json.at("identity"), json.at("job"),
                      json.at("tasks").get<Tasks>()};
  } catch (const std::exception&) {  // not JSON, or not of this form
    return std::nullopt;
  }
}

std::string this_program() {
  std::error_code error;
  const fs::path path = fs::read_symlink("/proc/self/exe", error);
  if (error) throw InputError("dsdpv1-sim: where this program stands is not known: " + error.message());
  return path.string();
}

}  // namespace

Slurm::Slurm(const fs::path& folder, std::string options)
    : folder_(fs::absolute(folder) / kSlurmFolder), options_(std::move(options)) {}

std::string Slurm::file(int submission, const std::string& ending) const {
  return (folder_ / (std::to_string(submission) + ending)).string();
}

std::vector<Submission> Slurm::submissions() const {
  std::vector<Submission> all;
  if (!fs::is_directory(folder_)) return all;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (entry.path().extension() != ".json") continue;
    if (const std::optional<Submission> found = submission_of(entry.path())) all.push_back(*found);
  }
  return all;
}

/// Its tasks find their jobs in the file, so it is written before they can begin, and again with Slurm's number.
Submission Slurm::submit(const std::string& identity, const Tasks& tasks,
                         const std::vector<std::string>& command) const {
  fs::create_directories(folder_);
  Submission made{1, identity, "", tasks};
  while (fs::exists(file(made.number, ".json"))) ++made.number;
  write(made);
  std::string script = "#!/bin/sh\nexec " + shell_word(this_program());
  for (const std::string& word : command) script += " " + shell_word(word);
  write_file(file(made.number, ".sh"), script + fmt::format(" --slurm-task {}\n", made.number));
  const Answer answer =
      ask(fmt::format("sbatch --parsable --job-name=dsdpv1-sim --array=0-{} --chdir={} --output={} {} {}",
                      tasks.size() - 1, shell_word(fs::current_path().string()),
                      shell_word(file(made.number, "_%a.out")), options_, shell_word(file(made.number, ".sh"))));
  if (!answer.good) {
    forget(made);
    throw InputError("dsdpv1-sim: --slurm: sbatch says " + campaign::last_line(answer.text));
  }
  const std::string line = campaign::last_line(answer.text);
  made.job = line.substr(0, line.find(';'));  // "4711" or "4711;cluster"
  write(made);
  return made;
}

void Slurm::write(const Submission& submission) const {
  const Json json = {{"identity", submission.identity}, {"job", submission.job}, {"tasks", submission.tasks}};
  write_file(file(submission.number, ".json"), text_of(json) + "\n");
}

std::optional<std::map<std::string, std::set<std::size_t>>> Slurm::under_way() {
  const Answer answer = ask("squeue --me --noheader --array --format='%F %K'");
  if (!answer.good) return std::nullopt;
  std::map<std::string, std::set<std::size_t>> tasks;
  std::istringstream lines(answer.text);
  for (std::string job, task; lines >> job >> task;)
    if (const auto number = parse_integer(task)) tasks[job].insert(static_cast<std::size_t>(*number));
  return tasks;
}

void Slurm::cancel(const Submission& submission) {
  if (!submission.job.empty()) ask("scancel " + shell_word(submission.job));
}

std::string Slurm::last_line(const Submission& submission, std::size_t task) const {
  return campaign::last_line(content(file(submission.number, fmt::format("_{}.out", task))));
}

void Slurm::forget(const Submission& submission) const {
  std::error_code ignored;  // an additional file in the folder does no harm
  for (const char* ending : {".json", ".sh"}) fs::remove(file(submission.number, ending), ignored);
  for (std::size_t task = 0; task < submission.tasks.size(); ++task)
    fs::remove(file(submission.number, fmt::format("_{}.out", task)), ignored);
  fs::remove(folder_, ignored);  // succeeds only when it is empty
}

std::vector<std::size_t> jobs_of_task(const fs::path& folder, int number, std::size_t jobs) {
  const char* const variable = std::getenv("SLURM_ARRAY_TASK_ID");  // NOLINT(concurrency-mt-unsafe): one thread
  const auto task = parse_integer(variable != nullptr ? variable : "");
  const auto submission = submission_of(folder / kSlurmFolder / (std::to_string(number) + ".json"));
  const auto is_there = [jobs](std::size_t job) { return job < jobs; };
  if (task && *task >= 0 && submission && static_cast<std::size_t>(*task) < submission->tasks.size()) {
    const std::vector<std::size_t>& own = submission->tasks[static_cast<std::size_t>(*task)];
    if (std::all_of(own.begin(), own.end(), is_there)) return own;
  }
  throw InputError("dsdpv1-sim: --slurm-task is for the tasks that --slurm has submitted, this is none of them");
}

Tasks in_tasks(const std::vector<std::size_t>& jobs, std::size_t most) {
  const std::size_t each = (jobs.size() + most - 1) / most;
  Tasks tasks;
  for (const std::size_t job : jobs) {
    if (tasks.empty() || tasks.back().size() == each) tasks.emplace_back();
    tasks.back().push_back(job);
  }
  return tasks;
}

}  // namespace dsdpv1::tb::campaign
