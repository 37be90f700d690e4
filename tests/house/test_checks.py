#!/usr/bin/env python3
"""Each rule of the house checks fires on a small wicked tree, and none fires on a good one."""

import shutil
import unittest
import unittest.mock

import check_credits
import check_format
import check_layers
import check_readme
import check_text
from wicked_tree import HEADER, Tree


class LayerRules(Tree):
    def findings(self):
        return check_layers.findings(check_layers.include_graph(self.root))

    FACE = {module: (f"{module}/seen.h",) for module in check_layers.LAYERS}

    def test_a_good_tree_has_no_findings(self):
        self.write("sessions/format/pose.h", HEADER + "#include <vector>\n")
        self.write("sessions/session.h", HEADER + '#include "sessions/format/pose.h"\n')
        self.write("scenes/model/scene.h", HEADER + '#include "sessions/format/pose.h"\n')
        self.write("renderer/renderer.h",
                   HEADER + '#include "scenes/model/scene.h"\n#include "sessions/format/pose.h"\n')
        self.write("renderer/embree/embree_api.h", HEADER + "#include <embree3/rtcore.h>\n")
        self.write("renderer/simd/kernel.cpp", "#include <hwy/highway.h>\n")
        self.write("renderer/frame/renderer.cpp",
                   '#include "renderer/renderer.h"\n#include "renderer/embree/embree_api.h"\n')
        self.write("server/main.cpp", '#include "renderer/renderer.h"\n')
        self.write("scenes/gltf/load.cpp", "#include <tiny_gltf.h>\n")
        self.write("scenes/samples/generator/main.cpp", '#include "scenes/model/scene.h"\n')
        self.write("tests/server/program/main_test.cpp",
                   '#include <gtest/gtest.h>\n#include "sessions/format/pose.h"\n')
        self.assertEqual(self.findings(), [])

    def test_every_wrong_way_is_found_and_every_right_way_is_not(self):
        layers = check_layers.LAYERS
        for here in layers:
            for there in layers:
                with self.subTest(here=here, there=there):
                    self.setUp()
                    header = self.FACE[there][0]
                    self.write(header, HEADER)
                    self.write(f"{here}/seer.cpp", f'\n#include "{header}"\n')
                    wrong = layers.index(there) > layers.index(here)
                    with unittest.mock.patch.object(check_layers.rooms, "FACE", self.FACE):
                        found = self.findings()
                    if wrong:
                        self.expect_one(found, f"{here}/seer.cpp:2", header, " <- ")
                    else:
                        self.assertEqual(found, [])

    def test_a_wrong_way_in_angle_brackets_or_with_odd_spaces_is_found(self):
        self.write("server/program.h", HEADER)
        self.write("sessions/a.cpp", "#include <server/program.h>\n")
        self.write("sessions/b.cpp", '  #  include   "server/program.h"  // why\n')
        self.write("sessions/c.cpp", '#include "../server/program.h"\n')
        self.assertEqual([f.split(":")[0] for f in self.findings() if " <- " in f],
                         ["sessions/a.cpp", "sessions/b.cpp", "sessions/c.cpp"])

    def test_an_include_in_a_comment_or_a_string_is_none(self):
        self.write("server/program.h", HEADER)
        self.write("sessions/a.cpp", '// #include "server/program.h"\n/*\n#include "server/program.h"\n*/\n'
                                     'const char* text = R"(\n#include "server/program.h"\n)";\n'
                                     "int n = 1'000'000;\n")
        self.assertEqual(self.findings(), [])

    def test_nothing_but_tests_includes_tests(self):
        self.write("tests/fakes.h", HEADER)
        self.write("tests/a_test.cpp", '#include "tests/fakes.h"\n')
        self.write("server/a.cpp", '#include "tests/fakes.h"\n')
        self.expect_one(self.findings(), "server/a.cpp:1", "nothing but tests")

    def test_a_cycle_is_found_once_with_its_whole_way(self):
        self.write("renderer/a.h", HEADER + '#include "renderer/b.h"\n')
        self.write("renderer/b.h", HEADER + '#include "renderer/c.h"\n')
        self.write("renderer/c.h", HEADER + '#include "renderer/a.h"\n')
        self.write("renderer/user.cpp", '#include "renderer/b.h"\n')
        self.expect_one(self.findings(), "renderer/c.h:3",
                        "renderer/a.h -> renderer/b.h -> renderer/c.h -> renderer/a.h")

    def test_a_header_that_includes_itself_is_a_cycle(self):
        self.write("renderer/a.h", HEADER + '#include "a.h"\n')
        self.expect_one(self.findings(), "renderer/a.h -> renderer/a.h")

    def test_a_diamond_is_no_cycle(self):
        self.write("renderer/top.h", HEADER)
        for side in "lr":
            self.write(f"renderer/{side}.h", HEADER + '#include "renderer/top.h"\n')
        self.write("renderer/bottom.h", HEADER + '#include "renderer/l.h"\n#include "renderer/r.h"\n')
        self.assertEqual(self.findings(), [])

    def test_each_foreign_header_is_refused_where_it_does_not_belong(self):
        for library in check_layers.FOREIGN:
            for header in library.headers:
                with self.subTest(library=library.name, header=header):
                    self.setUp()
                    self.write("scenes/scene.h", HEADER + f"#include <{header.replace('*', 'x')}>\n")
                    self.expect_one(self.findings(), "scenes/scene.h:3", library.name)

    def test_a_library_for_one_file_is_refused_in_a_second(self):
        self.write("scenes/gltf/a.cpp", "#include <tiny_gltf.h>\n")
        self.write("scenes/gltf/b.cpp", "#include <tiny_gltf.h>\n")
        self.expect_one(self.findings(), "scenes/gltf/b.cpp:1", "already in scenes/gltf/a.cpp")

    def test_includes_that_name_no_file_are_found(self):
        self.write("renderer/a.cpp", '#include "renderer/gone.h"\n')
        self.write("renderer/b.cpp", '#include "vector"\n')
        found = self.findings()
        self.assertEqual(len(found), 2, found)
        self.assertIn("does not exist", found[0])
        self.assertIn("stand in <>", found[1])


class RoomRules(Tree):
    """Floors within a module, and its face."""

    def findings(self):
        return check_layers.findings(check_layers.include_graph(self.root))

    def test_an_include_of_a_room_above_is_found_and_one_below_is_not(self):
        for module, names in check_layers.rooms.ROOMS.items():
            low, high = names[0], names[-1]
            with self.subTest(module=module):
                self.setUp()
                self.write(f"{module}/{low}/a.h", HEADER)
                self.write(f"{module}/{high}/b.h", HEADER + f'#include "{module}/{low}/a.h"\n')
                self.assertEqual(self.findings(), [])
                self.write(f"{module}/{low}/c.cpp", f'#include "{module}/{high}/b.h"\n')
                self.expect_one(self.findings(), f"{module}/{low}/c.cpp:1", "lies above")

    def test_a_circle_of_two_folders_is_found_with_both_includes(self):
        self.write("server/http/a.h", HEADER)
        self.write("server/replay/b.h", HEADER + '#include "server/http/a.h"\n')
        graph = check_layers.include_graph(self.root)
        self.assertEqual([*check_layers.circle_findings(graph)], [])
        self.write("server/http/c.cpp", '#include "server/replay/b.h"\n')
        graph = check_layers.include_graph(self.root)
        self.expect_one([*check_layers.circle_findings(graph)], "server/http/c.cpp:1", "server/replay/b.h:3")
        self.expect_one(self.findings(), "server/http/c.cpp:1", "lies above")

    def test_a_roof_may_include_every_room_and_no_room_its_roof(self):
        self.write("sessions/session.h", HEADER + '#include "sessions/import/a.h"\n')
        self.write("sessions/import/a.h", HEADER)
        self.assertEqual(self.findings(), [])
        self.write("sessions/files/b.cpp", '#include "sessions/session.h"\n')
        self.expect_one(self.findings(), "sessions/files/b.cpp:1", "lies above")

    def test_ground_may_be_included_by_every_room_and_includes_none(self):
        self.write("renderer/times.h", HEADER)
        self.write("renderer/simd/a.h", HEADER + '#include "renderer/times.h"\n')
        self.assertEqual(self.findings(), [])
        self.write("renderer/renderer.h", HEADER + '#include "renderer/simd/a.h"\n')
        self.expect_one(self.findings(), "renderer/renderer.h:3", "lies above")

    def test_a_header_that_is_not_of_the_face_is_refused_to_other_modules_and_not_to_tests(self):
        self.write("renderer/threads/inner.h", HEADER)
        self.write("tests/server/program/a_test.cpp", '#include "renderer/threads/inner.h"\n')
        self.assertEqual(self.findings(), [])
        self.write("server/cli/a.cpp", '#include "renderer/threads/inner.h"\n')
        self.expect_one(self.findings(), "server/cli/a.cpp:1", "not of the face of renderer/")

    def test_a_face_names_only_headers_that_are_there_and_that_others_include(self):
        self.write("sessions/session.h", HEADER)
        graph = check_layers.include_graph(self.root)
        with unittest.mock.patch.dict(check_layers.rooms.FACE, {"sessions": ("sessions/session.h", "sessions/gone.h")}):
            found = [*check_layers.face_findings(graph)]
        self.assertEqual(len(found), 2, found)
        self.assertIn("take it off", found[0])
        self.assertIn("does not exist", found[1])

    def test_a_folder_that_is_no_room_is_found_in_modules_and_in_tests(self):
        self.write("renderer/cellar/a.cpp", "\n")
        self.expect_one(self.findings(), "renderer/cellar/a.cpp:1", "no room of renderer/")
        self.setUp()
        self.write("tests/renderer/cellar/a_test.cpp", "\n")
        self.expect_one(self.findings(), "tests/renderer/cellar/a_test.cpp:1", "no room of renderer/")

    def test_25_files_in_a_folder_pass_and_26_do_not(self):
        for i in range(25):
            self.write(f"server/cli/f{i}.cpp", "\n")
        self.assertEqual(self.findings(), [])
        self.write("server/cli/f25.cpp", "\n")
        self.expect_one(self.findings(), "server/cli/:1", "26 C++ files")


class TextRules(Tree):
    def findings(self):
        return check_text.findings(self.root)

    def test_a_good_tree_has_no_findings(self):
        self.write("sessions/pose.h", HEADER)
        self.write("sessions/pose.cpp", 'int f() { return std::snprintf(b, 9, "exit(1)"); }  // never exit()\n')
        self.write("server/main.cpp", "int main() { std::cout << 1; std::exit(0); }\n")
        self.write("scenes/samples/generator/main.cpp", "int main() { std::cerr << 1; }\n")
        self.write("CMakeLists.txt", "# no -march=native here\n")
        self.assertEqual(self.findings(), [])

    def test_a_header_without_guard_is_found(self):
        self.write("sessions/pose.h", "// What it is.\nint x;\n")
        self.expect_one(self.findings(), "sessions/pose.h:1", "#pragma once")

    def test_a_guard_in_a_comment_is_none(self):
        self.write("sessions/pose.h", "// #pragma once\n")
        self.expect_one(self.findings(), "#pragma once")

    def test_a_header_without_opening_lines_is_found(self):
        self.write("sessions/pose.h", "#pragma once\n// Late.\n")
        self.expect_one(self.findings(), "sessions/pose.h:1", "opens with")

    def test_400_lines_pass_and_401_do_not(self):
        self.write("server/long.cpp", "\n" * 400)
        self.assertEqual(self.findings(), [])
        self.write("server/long.cpp", "\n" * 401)
        self.expect_one(self.findings(), "server/long.cpp:401", "split it")

    def test_a_folder_for_leftovers_is_found(self):
        self.write("renderer/util/a.cpp", "\n")
        self.expect_one(self.findings(), "renderer/util/a.cpp:1", "concept")

    def test_each_way_to_print_or_exit_is_found_below_the_server(self):
        for call in ("std::cout << 1", "std::cerr << 1", 'printf("")', 'std::fprintf(f, "")', "exit(1)", "std::abort()"):
            with self.subTest(call=call):
                self.setUp()
                self.write("renderer/a.cpp", f"void f() {{\n  {call};\n}}\n")
                self.expect_one(self.findings(), "renderer/a.cpp:2", "throw instead")

    def test_each_way_past_the_seam_to_files_is_found(self):
        for line in ("#include <fstream>", "#include <fcntl.h>", "#include  <sys/stat.h>", "std::ifstream f(p);",
                     "std::ofstream f(p);", "int f = ::open(p, 0);", "::rename(a, b);", "if (::fsync(f) != 0) x();",
                     "::unlink(p);", "::write(f, b, 1);", "std::FILE* f = std::fopen(p, m);", "auto f = fopen(p, m);",
                     "std::filesystem::remove_all(p);", "fs::create_directories(p);", "for (auto e : fs::directory_iterator(p)) x();",
                     "if (std::filesystem::exists(p)) x();", "fs::rename(a, b);"):
            for file in ("sessions/a.cpp", "server/output/a.h"):
                with self.subTest(line=line, file=file):
                    self.setUp()
                    self.write(file, f"// What.\n#pragma once\n{line}\n")
                    self.expect_one(self.findings(), f"{file}:3", "sessions/files/")

    def test_names_sockets_and_the_seam_itself_are_no_file_work(self):
        self.write("sessions/files/kernel.cpp", "#include <fcntl.h>\nint f() { return ::open(p, 0) + ::rename(a, b); }\n")
        self.write("server/http/socket.cpp", "#include <fcntl.h>\nvoid f() { ::read(s, b, 1); ::close(s); }\n")
        self.write("server/a.cpp", "auto s = Session::open(p); auto q = std::filesystem::absolute(p); file.read(b, 1);\n"
                                   "// std::ofstream and ::open() are not used\nfile_system().rename(a, b); store.remove(x);\n")
        self.write("tests/a_test.cpp", "#include <fstream>\nstd::ofstream f(p);\n")
        self.assertEqual(self.findings(), [])
        self.write("server/http/page.cpp", "void f() { ::open(p, 0); }\n")
        self.expect_one(self.findings(), "server/http/page.cpp:1", "::open")

    def test_flags_that_change_arithmetic_are_found(self):
        self.write("renderer/CMakeLists.txt", "add_compile_options(-O2\n  -ffast-math)  # fast\n")
        self.expect_one(self.findings(), "renderer/CMakeLists.txt:2", "-ffast-math")


class ReadmeRules(Tree):
    HELPS = {None: "--help\n--version\nSubcommands:\n  replay   render\n  check    did frames become slower?\n",
             "replay": "--out DIR\n--scene FILE\n", "check": "--only TIER\n"}
    README = "# X\n```sh\nherr replay S --out DIR --scene F\n```\n`herr check`: `cmake --preset x`\n"

    def option_findings(self, readme, **more):
        self.write("README.md", readme)
        for path, text in more.items():
            self.write(path.replace("__", "/") + ".md", text)
        return [*check_readme.option_findings(self.root, self.HELPS.get)]

    def test_a_link_to_nothing_is_found_and_others_are_not(self):
        self.write("a/b.h", HEADER)
        self.write("README.md", "[b](a/b.h) [b](a/b.h#l) [w](https://example.org/x) [here](#state)\n\n![p](gone.png)\n")
        self.expect_one(list(check_readme.link_findings(self.root)), "README.md:3", "gone.png")

    def test_options_of_the_helps_are_no_finding(self):
        self.assertEqual(self.option_findings(self.README, server__check__README="`--only`"), [])

    def test_an_option_that_no_command_has_is_found(self):
        self.expect_one(self.option_findings(self.README + "`--scenes`\n"), "--scenes", "not list")

    def test_an_option_of_another_command_is_found_on_a_command_line(self):
        readme = self.README.replace("--scene F", "--only times")
        self.expect_one(self.option_findings(readme), "--only", "herr replay --help")

    def test_a_command_line_that_goes_on_in_the_next_line_is_read_whole(self):
        readme = self.README.replace("--scene F", "\\\n  --only times")
        self.expect_one(self.option_findings(readme), "--only", "herr replay --help")

    def test_an_option_of_another_command_is_found_in_the_room_of_a_command(self):
        found = self.option_findings(self.README, server__check__measure__README="`--out`")
        self.expect_one(found, "server/check/measure/README.md", "--out", "herr check --help")

    def test_a_command_that_the_top_readme_leaves_out_is_found(self):
        self.expect_one(self.option_findings("`herr replay`\n"), "leaves out `herr check`")

    def test_a_help_without_commands_is_no_pass(self):
        with unittest.mock.patch.dict(self.HELPS, {None: "Subcommands:\n"}):
            self.expect_one(self.option_findings("# X\n"), "lists no commands")

    def test_a_room_without_a_readme_is_found_and_one_that_is_not_built_is_not(self):
        self.write("sessions/README.md", "# s\n")
        self.write("sessions/files/a.h", HEADER)
        self.expect_one([*check_readme.room_findings(self.root)], "sessions/files", "no README.md")
        self.write("sessions/files/README.md", "# f\n")
        self.assertEqual([*check_readme.room_findings(self.root)], [])

    def test_a_top_readme_of_more_than_a_page_is_found(self):
        self.write("README.md", "x\n" * check_readme.MOST_LINES)
        self.assertEqual([*check_readme.length_findings(self.root)], [])
        self.write("README.md", "x\n" * (check_readme.MOST_LINES + 1))
        self.expect_one([*check_readme.length_findings(self.root)], "README.md", "151 lines")

    def test_a_source_file_that_is_not_there_is_found_by_line(self):
        self.write("server/http/a.h", HEADER)
        self.write("server/http/README.md", "`a.h` `http/a.h` `server/http/a.h` `frames.csv` `-inl.h`\n`b.h`\n")
        self.expect_one([*check_readme.name_findings(self.root)], "server/http/README.md:2", "names b.h")


@unittest.skipUnless(shutil.which("clang-format"), "clang-format is missing; run scripts/install-packages")
class FormatRules(Tree):
    def setUp(self):
        super().setUp()
        self.write(".clang-format", "BasedOnStyle: Google\n")

    def findings(self):
        return check_format.findings(self.root, shutil.which("clang-format"))

    def test_a_file_in_another_layout_is_found_once_with_its_first_line(self):
        self.write("sessions/good.cpp", "int f() { return 1; }\n")
        self.write("sessions/bad.cpp", "int g() { return 1; }\nint  f( )\n{ return  1 ; }\n")
        self.expect_one(self.findings(), "sessions/bad.cpp:2")

    def test_a_broken_configuration_is_no_pass(self):
        self.write(".clang-format", "BasedOnStyle: Nobody\n")
        self.write("sessions/good.cpp", "int f() { return 1; }\n")
        self.assertNotEqual(self.findings(), [])


class CreditRules(Tree):
    LINKED = {"libembree3.so.3": "herr", "libc.so.6": "herr", "libstdc++.so.6": "herr"}

    def setUp(self):
        super().setUp()
        self.write("renderer/a.cpp", "#include <embree3/rtcore.h>\n#include <sys/stat.h>\n#include <vector>\n#include <unistd.h>\n")
        self.write("README.md", "# A program\n## Licence and credits\n[Embree](https://www.embree.org)\n")

    def findings(self, linked=None):
        return list(check_credits.findings(self.root, self.LINKED if linked is None else linked))

    def test_a_tree_with_its_credits_has_no_findings(self):
        self.assertEqual(self.findings(), [])

    def test_a_linked_library_without_credit_is_found(self):
        self.expect_one(self.findings({**self.LINKED, "libz.so.1": "herr"}), "README.md", "leave out zlib")

    def test_an_included_library_without_credit_is_found(self):
        self.write("server/b.cpp", "#include <nlohmann/json.hpp>\n")
        self.expect_one(self.findings(), "README.md", "leave out JSON for Modern C++")

    def test_a_packaged_file_without_credit_is_found(self):
        self.write("server/CMakeLists.txt", "find_file(CHART x PATHS /usr/share/javascript/chart.js)\n")
        self.expect_one(self.findings(), "README.md", "leave out Chart.js")

    def test_a_font_without_credit_is_found(self):
        self.write("scripts/install-packages", "packages=(fonts-dejavu-core)\n")
        self.expect_one(self.findings(), "README.md", "leave out DejaVu")

    def test_what_no_row_knows_is_found(self):
        self.expect_one(self.findings({**self.LINKED, "libnew.so.1": "herr"}), "herr", "libnew.so.1", "no row")
        self.write("server/b.cpp", "#include <novel.h>\n")
        self.expect_one(self.findings(), "server/b.cpp:1", "novel.h", "no row")

    def test_a_credit_for_nothing_is_found(self):
        self.write("README.md", "## Credits\nEmbree, Expat, CLI11\n")
        found = self.findings()
        self.assertEqual(len(found), 2, found)
        self.assertIn("name CLI11, which nothing", found[0])
        self.assertIn("name Expat, which nothing", found[1])

    def test_credits_elsewhere_in_the_page_do_not_count(self):
        self.write("README.md", "# About Embree\n## Credits\nnobody\n## Embree\n")
        self.expect_one(self.findings(), "leave out Embree")
        self.write("README.md", "# About Embree\n")
        self.expect_one(self.findings(), "no section of credits")

    def test_a_program_names_what_it_links(self):
        self.assertTrue(any(name.startswith("libc.so") for name in check_credits.linked_objects(shutil.which("readelf"))))


if __name__ == "__main__":
    unittest.main()
