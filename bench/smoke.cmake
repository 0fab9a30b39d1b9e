# That each benchmark starts, or runs at a small size: ctest -L bench.
function(limber_smoke name what)
  add_test(NAME bench.${name}.${what} COMMAND bench_${name} ${ARGN})
  set_tests_properties(bench.${name}.${what} PROPERTIES LABELS bench TIMEOUT 600)
endfunction()

foreach(name IN ITEMS step_cost start_cost whole_mesh hub meshing)
  limber_smoke(${name} ListsItsCases --benchmark_list_tests)
endforeach()
foreach(name IN ITEMS report trade slew tolerance departure chain extremes)
  limber_smoke(${name} ExplainsItself --help)
endforeach()
limber_smoke(offline ReducesASmallBox 0.5)
limber_smoke(hub RunsItsSmallestCase --benchmark_filter=/6$
  --benchmark_min_time=0.001)
limber_smoke(random_scenes RunsThree --number 3)
