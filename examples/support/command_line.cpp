// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <slant/concepts/bad_input.hpp>
#include <slant/io/text_scanner.hpp>

namespace examples {

namespace {

int refuse(std::string_view program, std::string_view message) {
  std::string const line = slant::detail::printable(message, false);
  std::fprintf(stderr, "%.*s: %s\n", static_cast<int>(program.size()), program.data(),
               line.c_str());
  return refused;
}

/// What CLI11 says, in the words of this project.
std::string explanation(CLI::App const& app, CLI::ParseError const& failure) {
  std::string said = failure.what();
  if (auto const extra = app.remaining();
      dynamic_cast<CLI::ExtrasError const*>(&failure) && !extra.empty())
    return "argument: got " + extra.back() + ", expected one of those that --help lists";
  if (dynamic_cast<CLI::ArgumentMismatch const*>(&failure)) {
    std::string const option = said.substr(0, said.find(':'));
    if (auto const* const found = app.get_option_no_throw(option))
      return option + ": got " +
             (found->count() == 0 ? "nothing" : std::to_string(found->count()) + " values") +
             ", expected one";
  }
  return said;
}

}  // namespace

check expects_one_of(std::vector<std::string> words) {
  std::string expectation = words.front();
  for (std::size_t i = 1; i < words.size(); ++i) {
    expectation += (i + 1 < words.size() ? ", " : " or ") + words[i];
  }
  return expects<std::string>(expectation, [words = std::move(words)](std::string const& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  });
}

void make_folder(std::string_view option, std::filesystem::path const& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && !std::filesystem::is_directory(folder, error))
    error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    throw slant::bad_input(option, slant::detail::printable(folder) + " (" + error.message() + ")",
                           "a folder that exists or can be created");
}

void require_printed() {
  std::cout.flush();
  if (!std::cout.good() || std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw slant::bad_input("standard output", "an error", "room for the result");
}

struct command_line::parser : CLI::App {
  using CLI::App::App;
};

command_line::command_line(std::string const& about, std::string const& name,
                           std::string_view footer)
    : parser_(std::make_unique<parser>(about, name)) {
  parser_->footer(std::string(footer));
}
command_line::~command_line() = default;

void command_line::add(description const& option, std::function<bool(texts const&)> store) {
  auto* const added = parser_->add_option(option.name, std::move(store), option.help);
  added->type_name(option.type)->type_size(1)->expected(option.least, option.most);
  added->allow_extra_args(option.most != option.least);
  added->default_str(option.shown);
  if (!option.allowed) return;
  added->check(CLI::Validator(
      [allowed = option.allowed](std::string& text) { return allowed(text); }, "", ""));
}

void command_line::flag(std::string const& name, bool& value, std::string const& help) {
  parser_->add_flag(name, value, help);
}

int command_line::run(int argc, char const* const* argv, std::function<int()> const& body) {
  std::string const name = parser_->get_name();
  try {
    parser_->parse(argc, argv);
    int const status = body();
    require_printed();
    return status;
  } catch (CLI::ParseError const& failure) {
    if (failure.get_exit_code() == 0) return parser_->exit(failure);  // --help
    return refuse(name, explanation(*parser_, failure));
  } catch (std::bad_alloc const&) {
    return refuse(name, "memory: got too little, expected enough for this problem");
  } catch (std::exception const& failure) {
    return refuse(name, failure.what());
  }
}

}  // namespace examples
