# Draws error-frontier-pressed-sphere.svg and error-frontier-pressed-sphere.png: gnuplot error-frontier-pressed-sphere.gp
set encoding utf8
do for [kind in 'svg png'] {
if (kind eq 'svg') {
set terminal svg size 900,520 font 'sans,14' background 'white'
} else {
set terminal pngcairo size 1350,780 font 'sans,18'
}
set output 'error-frontier-pressed-sphere.'.kind
set datafile separator ','
set datafile missing NaN
set title 'Time for a given error: pressed-sphere, nu 0.3'
set xlabel 'error asked for'
set ylabel 'until ready to drag [s]'
set grid lc rgb '#dddddd' lt 1
set key outside right top Left reverse
set tics nomirror
set border 3
set logscale x
set format x '%g'
set logscale y
set format y '%g'
set xrange [0.15:0.0007]
plot \
  'error-frontier.csv' using ((strcol('error') eq 'error' && strcol('problem') eq 'pressed-sphere' && strcol('nu') eq '0.3' && strcol('time') eq 'ready_s' && strcol('variant') eq 'galerkin-bem' ? column('target') : NaN)):(column('seconds')) with linespoints lc rgb '#cc79a7' lw 2 pt 13 ps 0.8 dt 1 title 'galerkin-bem', \
  'error-frontier.csv' using ((strcol('error') eq 'error' && strcol('problem') eq 'pressed-sphere' && strcol('nu') eq '0.3' && strcol('time') eq 'ready_s' && strcol('variant') eq 'quadratic-fem' ? column('target') : NaN)):(column('seconds')) with linespoints lc rgb '#e69f00' lw 2 pt 11 ps 0.8 dt 1 title 'quadratic-fem', \
  'error-frontier.csv' using ((strcol('error') eq 'error' && strcol('problem') eq 'pressed-sphere' && strcol('nu') eq '0.3' && strcol('time') eq 'ready_s' && strcol('variant') eq 'linear-bem' ? column('target') : NaN)):(column('seconds')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 1 title 'linear-bem', \
  'error-frontier.csv' using ((strcol('error') eq 'error' && strcol('problem') eq 'pressed-sphere' && strcol('nu') eq '0.3' && strcol('time') eq 'ready_s' && strcol('variant') eq 'linear-bem restricted' ? column('target') : NaN)):(column('seconds')) with linespoints lc rgb '#56b4e9' lw 2 pt 6 ps 0.8 dt 2 title 'linear-bem restricted', \
  'error-frontier.csv' using ((strcol('error') eq 'error' && strcol('problem') eq 'pressed-sphere' && strcol('nu') eq '0.3' && strcol('time') eq 'ready_s' && strcol('variant') eq 'linear-bem continuous' ? column('target') : NaN)):(column('seconds')) with linespoints lc rgb '#666666' lw 2 pt 4 ps 0.8 dt 2 title 'linear-bem continuous', \
  'error-frontier.csv' using ((strcol('error') eq 'error' && strcol('problem') eq 'pressed-sphere' && strcol('nu') eq '0.3' && strcol('time') eq 'ready_s' && strcol('variant') eq 'fem' ? column('target') : NaN)):(column('seconds')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 1 title 'fem', \
  'error-frontier.csv' using ((strcol('error') eq 'error' && strcol('problem') eq 'pressed-sphere' && strcol('nu') eq '0.3' && strcol('time') eq 'ready_s' && strcol('variant') eq 'constant-bem' ? column('target') : NaN)):(column('seconds')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 1 title 'constant-bem'
unset output
reset
}
