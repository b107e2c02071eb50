# Draws scale-memory.svg and scale-memory.png: gnuplot scale-memory.gp
set encoding utf8
do for [kind in 'svg png'] {
if (kind eq 'svg') {
set terminal svg size 900,520 font 'sans,14' background 'white'
} else {
set terminal pngcairo size 1350,780 font 'sans,18'
}
set output 'scale-memory.'.kind
set datafile separator ','
set datafile missing NaN
set title 'Peak memory of the precomputation'
set xlabel 'vertices'
set ylabel 'bytes'
set grid lc rgb '#dddddd' lt 1
set key outside right top Left reverse
set tics nomirror
set border 3
set logscale x
set format x '%g'
set logscale y
set format y '%g'
plot \
  'scale.csv' using ((strcol('method') eq 'galerkin-bem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('measured_bytes')) with linespoints lc rgb '#cc79a7' lw 2 pt 13 ps 0.8 dt 1 title 'galerkin-bem, on-demand', \
  'scale.csv' using ((strcol('method') eq 'quadratic-fem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('measured_bytes')) with linespoints lc rgb '#e69f00' lw 2 pt 11 ps 0.8 dt 1 title 'quadratic-fem, on-demand', \
  'scale.csv' using ((strcol('method') eq 'nonlinear-fem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('measured_bytes')) with linespoints lc rgb '#56b4e9' lw 2 pt 6 ps 0.8 dt 1 title 'nonlinear-fem, on-demand', \
  'scale.csv' using ((strcol('method') eq 'fem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('measured_bytes')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 1 title 'fem, on-demand', \
  'scale.csv' using ((strcol('method') eq 'constant-bem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('measured_bytes')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 1 title 'constant-bem, on-demand', \
  'scale.csv' using ((strcol('method') eq 'linear-bem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('measured_bytes')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 1 title 'linear-bem, on-demand', \
  'scale.csv' using ((strcol('method') eq 'galerkin-bem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('predicted_bytes')) with lines lc rgb '#cc79a7' lw 2 dt 2 title 'galerkin-bem, on-demand, predicted', \
  'scale.csv' using ((strcol('method') eq 'quadratic-fem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('predicted_bytes')) with lines lc rgb '#e69f00' lw 2 dt 2 title 'quadratic-fem, on-demand, predicted', \
  'scale.csv' using ((strcol('method') eq 'nonlinear-fem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('predicted_bytes')) with lines lc rgb '#56b4e9' lw 2 dt 2 title 'nonlinear-fem, on-demand, predicted', \
  'scale.csv' using ((strcol('method') eq 'fem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('predicted_bytes')) with lines lc rgb '#0072b2' lw 2 dt 2 title 'fem, on-demand, predicted', \
  'scale.csv' using ((strcol('method') eq 'constant-bem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('predicted_bytes')) with lines lc rgb '#d55e00' lw 2 dt 2 title 'constant-bem, on-demand, predicted', \
  'scale.csv' using ((strcol('method') eq 'linear-bem' && strcol('mode') eq 'on-demand' ? column('vertices') : NaN)):(column('predicted_bytes')) with lines lc rgb '#009e73' lw 2 dt 2 title 'linear-bem, on-demand, predicted'
unset output
reset
}
