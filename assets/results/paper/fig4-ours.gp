# Draws fig4-ours.svg and fig4-ours.png: gnuplot fig4-ours.gp
set encoding utf8
do for [kind in 'svg png'] {
if (kind eq 'svg') {
set terminal svg size 900,520 font 'sans,14' background 'white'
} else {
set terminal pngcairo size 1350,780 font 'sans,18'
}
set output 'fig4-ours.'.kind
set datafile separator ','
set datafile missing NaN
set title 'Precomputation: the paper''s way, and ready on demand'
set xlabel 'vertices'
set ylabel 'precomputation [s]'
set grid lc rgb '#dddddd' lt 1
set key outside right top Left reverse
set tics nomirror
set border 3
set logscale x
set format x '%g'
set logscale y
set format y '%g'
plot \
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'fem' && strcol('part') eq 'precompute' ? column('vertices') : NaN)):(column('precompute_s')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 1 title 'fem, paper', \
  'paper.csv' using ((strcol('way') eq 'ours' && strcol('method') eq 'fem' && strcol('part') eq 'update' && strcol('update') eq 'on-demand' && strcol('share') eq '0.1' && strcol('choice') eq 'random' ? column('vertices') : NaN)):(column('ready_s')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 2 title 'fem, on demand', \
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'constant-bem' && strcol('part') eq 'precompute' ? column('vertices') : NaN)):(column('precompute_s')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 1 title 'constant-bem, paper', \
  'paper.csv' using ((strcol('way') eq 'ours' && strcol('method') eq 'constant-bem' && strcol('part') eq 'update' && strcol('update') eq 'on-demand' && strcol('share') eq '0.1' && strcol('choice') eq 'random' ? column('vertices') : NaN)):(column('ready_s')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 2 title 'constant-bem, on demand', \
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'linear-bem' && strcol('part') eq 'precompute' ? column('vertices') : NaN)):(column('precompute_s')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 1 title 'linear-bem, paper', \
  'paper.csv' using ((strcol('way') eq 'ours' && strcol('method') eq 'linear-bem' && strcol('part') eq 'update' && strcol('update') eq 'on-demand' && strcol('share') eq '0.1' && strcol('choice') eq 'random' ? column('vertices') : NaN)):(column('ready_s')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 2 title 'linear-bem, on demand'
unset output
reset
}
